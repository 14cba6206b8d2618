"""GPS: known points on the earth, distances on it, noise, and a square that closes."""

from __future__ import annotations

from math import cos, radians
from pathlib import Path

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import heard
from urdfkit.description import load
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.plugins.sensors.navigation.geodesy import Earth

WORLD = """<sdf version="1.9"><world name="w"><gravity>0 0 0</gravity>
<spherical_coordinates><latitude_deg>52.0</latitude_deg>
<longitude_deg>4.5</longitude_deg><elevation>10</elevation><heading_deg>{heading}</heading_deg></spherical_coordinates>
</world></sdf>"""


def test_the_origin_is_where_the_world_says() -> None:
    earth = Earth(radians(52.0), radians(4.5), 10.0)
    assert earth.locate(np.zeros(3)) == pytest.approx((52.0, 4.5, 10.0), abs=1e-9)
    assert earth.locate(np.array([0, 0, 90.0])) == pytest.approx((52.0, 4.5, 100.0), abs=1e-9)


def test_metres_are_degrees_as_the_ellipsoid_has_them() -> None:
    # Radii of curvature at 52° north: 6384.1 km along the parallel's normal section, 6374.9 km along the meridian.
    e2 = 0.0066943799901413165
    w = 1 - e2 * np.sin(radians(52.0)) ** 2
    across, along = 6378137.0 / np.sqrt(w), 6378137.0 * (1 - e2) / w**1.5
    latitude, longitude, _ = Earth(radians(52.0), radians(4.5)).locate(np.array([10.0, 20.0, 0.0]))
    assert (latitude - 52.0) * radians(1) * along == pytest.approx(20.0, abs=1e-4)
    assert (longitude - 4.5) * radians(1) * across * cos(radians(52.0)) == pytest.approx(10.0, abs=1e-3)
    north = Earth(radians(52.0), radians(4.5), heading=radians(90.0)).locate(np.array([20.0, 0.0, 0.0]))
    assert north[0] == pytest.approx(latitude, abs=1e-9)


@pytest.fixture
def drone(tmp_path: Path):
    def make(sensor: str, *, world: str = WORLD.format(heading=0), **options) -> Simulator:
        (tmp_path / "drone.urdf").write_text(
            '<robot name="drone"><link name="base"><inertial><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1" '
            'ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<gazebo reference="base">{sensor}</gazebo></robot>'
        )
        (tmp_path / "w.sdf").write_text(world)
        return Simulator(load(tmp_path / "drone.urdf"), world=tmp_path / "w.sdf", **options)

    return make


def gps(plugin: str = "", inside: str = "", type: str = "gps", more: str = "") -> str:
    return f'<sensor name="g" type="{type}"><update_rate>10</update_rate>{inside}{plugin}{more}</sensor>'


ROS_2 = '<plugin name="gps" filename="libgazebo_ros_gps_sensor.so"><ros><namespace>n</namespace></ros></plugin>'


@pytest.mark.parametrize(
    ("sensor", "topic", "frame"),
    [
        (gps(ROS_2), "/n/gps/out", "base"),
        (gps(type="navsat", more="<topic>fix</topic>"), "/fix", "drone/base/g"),
    ],
)
def test_a_moving_receiver_tells_where_it_is(drone, sensor: str, topic: str, frame: str) -> None:
    simulator = drone(sensor, spawn=Spawn(z=5.0, twist=(3.0, 0, 0, 0, 0, 0)))
    messages = heard(simulator, topic, 1.0)
    assert len(messages) == 10
    here = Earth(radians(52.0), radians(4.5), 10.0).locate(np.array([3.0, 0.0, 5.0]))
    last = messages[-1]
    assert (last.latitude, last.longitude, last.altitude) == pytest.approx(here, abs=1e-9)
    assert (last.header.frame_id, last.status.status, last.position_covariance_type) == (frame, 0, 2)


def test_a_square_closes(drone) -> None:
    simulator = drone(gps(ROS_2), spawn=Spawn(z=5.0))
    topic = "/n/gps/out"
    start = heard(simulator, topic, 0.1)[-1]
    for velocity in ((2.0, 0, 0), (0, 2.0, 0), (-2.0, 0, 0), (0, -2.0, 0)):
        pose = simulator.state.base_pose
        simulator.world.place("drone", simulator_pose(pose), (*velocity, 0, 0, 0))
        simulator.run(1.0)
    simulator.world.place("drone", simulator_pose(simulator.state.base_pose))
    end = heard(simulator, topic, 0.1)[-1]
    assert (end.latitude, end.longitude) == pytest.approx((start.latitude, start.longitude), abs=1e-10)


def simulator_pose(pose):
    from urdfkit.sim.state.poses import pose_from

    return pose_from(pose)


def test_noise_is_in_metres(drone) -> None:
    noise = '<noise type="gaussian"><stddev>2.0</stddev></noise>'
    inside = (
        f"<gps><position_sensing><horizontal>{noise}</horizontal><vertical>{noise.replace('2.0', '5.0')}</vertical>"
        "</position_sensing></gps>"
    )
    messages = heard(drone(gps(ROS_2, inside), spawn=Spawn(z=5.0)), "/n/gps/out", 100.0)
    north = np.array([m.latitude - 52.0 for m in messages]) * radians(1) * 6378137
    east = np.array([m.longitude - 4.5 for m in messages]) * radians(1) * 6378137 * cos(radians(52))
    up = np.array([m.altitude - 15.0 for m in messages])
    assert len(messages) == 1000
    for found, deviation in ((north, 2.0), (east, 2.0), (up, 5.0)):
        assert abs(found.mean()) < 5 * deviation / np.sqrt(1000)
        assert found.std() == pytest.approx(deviation, rel=0.12)
    assert messages[0].position_covariance[[0, 4, 8]].tolist() == [4.0, 4.0, 25.0]


def test_a_world_that_lies_nowhere_is_remarked_on(drone) -> None:
    notes: list[str] = []
    drone(gps(ROS_2), world='<sdf version="1.9"><world name="w"/></sdf>', note=notes.append)
    assert any("no <spherical_coordinates>; GPS `g` uses latitude and longitude zero" in note for note in notes)
