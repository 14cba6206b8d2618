"""Altimeters, air pressure, magnetometers and logical cameras of gz sim, and hector's sensors."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, radians, sin
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import heard, scan
from tests.sim.plugins.sensors.navigation.test_gps import WORLD
from tests.sim.plugins.sensors.test_point_motion import four, three
from tests.suggestions import contains
from urdfkit.description import load
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.plugins.sensors.hector_drift import Drifting
from urdfkit.sim.plugins.sensors.navigation.altimeter_and_barometer import pressure


@pytest.fixture
def drone(tmp_path: Path) -> Callable[..., Any]:
    """Return what makes a simulator of a free body without gravity, that carries sensors or has plugins."""

    def make(
        sensors: str = "", plugins: str = "", *, world: str = WORLD.format(heading=0), **options: Any
    ) -> Simulator:
        (tmp_path / "drone.urdf").write_text(
            '<robot name="drone"><link name="base"><inertial><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1" '
            'ixy="0" ixz="0" iyz="0"/></inertial></link><link name="eye"/><joint name="j" type="fixed">'
            '<parent link="base"/><child link="eye"/><origin xyz="0 0 0.5"/></joint>'
            f'<gazebo reference="eye">{sensors}</gazebo><gazebo>{plugins}</gazebo></robot>'
        )
        (tmp_path / "w.sdf").write_text(world)
        options.setdefault("note", lambda _: None)
        return Simulator(load(tmp_path / "drone.urdf"), world=tmp_path / "w.sdf", **options)

    return make


def bare(type: str, inside: str = "", topic: str = "<topic>t</topic>") -> str:
    return f'<sensor name="s" type="{type}"><update_rate>50</update_rate>{topic}{inside}</sensor>'


def hector(name: str, inside: str = "") -> str:
    return f'<plugin name="p" filename="libhector_gazebo_ros_{name}.so">{inside}</plugin>'


def noise(deviation: float) -> str:
    return f'<noise type="gaussian"><stddev>{deviation}</stddev></noise>'


def test_the_standard_atmosphere() -> None:
    # ISO 2533: 1013.25, 898.76 and 540.48 hPa.
    assert pressure(0.0) == pytest.approx(101325.0)
    assert pressure(1000.0) == pytest.approx(89876.3, rel=1e-5)
    assert pressure(5000.0) == pytest.approx(54048.0, rel=1e-4)


def test_air_pressure_is_that_of_its_height(drone) -> None:
    inside = (
        f"<air_pressure><reference_altitude>100</reference_altitude><pressure>{noise(3.0)}</pressure></air_pressure>"
    )
    messages = heard(drone(bare("air_pressure", inside), spawn=Spawn(z=20.0)), "/t", 20.0)
    values = np.array([message.fluid_pressure for message in messages])
    assert len(values) == 1000
    assert values.mean() == pytest.approx(pressure(120.5), abs=5 * 3.0 / np.sqrt(1000))
    assert values.std() == pytest.approx(3.0, rel=0.12)
    assert messages[0].variance == 9.0
    assert messages[0].header.frame_id == "drone/eye/s"


def test_an_altimeter_tells_height_over_where_it_started_and_climb(drone) -> None:
    simulator = drone(bare("altimeter"), spawn=Spawn(z=20.0, twist=(1.0, 0, 0.25, 0, 0, 0)))
    simulator.run(1.0)
    message = heard(simulator, "/t", 1.0)[-1]
    assert message.vertical_position == pytest.approx(0.25 * 2.0, abs=0.25 * simulator.dt + 1e-9)
    assert message.vertical_velocity == pytest.approx(0.25, abs=1e-9)
    assert message.vertical_reference == pytest.approx(20.5, abs=0.25 * simulator.dt + 1e-9)
    noisy = f"<altimeter><vertical_velocity>{noise(0.1)}</vertical_velocity></altimeter>"
    climbs = [message.vertical_velocity for message in heard(drone(bare("altimeter", noisy)), "/t", 20.0)]
    assert np.std(climbs) == pytest.approx(0.1, rel=0.12)


@pytest.mark.parametrize(
    ("type", "topic"),
    [("altimeter", "altimeter"), ("air_pressure", "air_pressure"), ("magnetometer", "magnetometer")],
)
def test_topics_of_gz_sim_are_scoped(drone, type: str, topic: str) -> None:
    simulator = drone(bare(type, topic=""))
    assert heard(simulator, f"/world/w/model/drone/link/eye/sensor/s/{topic}", 0.1)


def test_a_magnetometer_tells_the_worlds_field_in_its_axes(drone) -> None:
    world = WORLD.format(heading=0).replace("<gravity>", "<magnetic_field>1e-5 2e-5 -4e-5</magnetic_field><gravity>")
    simulator = drone(bare("magnetometer"), world=world, spawn=Spawn(z=5.0, yaw=np.pi / 2))
    message = heard(simulator, "/t", 0.1)[-1]
    assert three(message.magnetic_field) == pytest.approx((2e-5, -1e-5, -4e-5), abs=1e-12)
    inside = f"<magnetometer><x>{noise(1e-6)}</x></magnetometer>"
    messages = heard(drone(bare("magnetometer", inside), world=world), "/t", 20.0)
    assert np.std([m.magnetic_field.x for m in messages]) == pytest.approx(1e-6, rel=0.12)
    assert len({m.magnetic_field.y for m in messages}) == 1
    assert messages[0].magnetic_field_covariance[0] == pytest.approx(1e-12)


def test_a_logical_camera_lists_the_models_in_its_frustum(drone) -> None:
    inside = (
        "<logical_camera><near>0.5</near><far>5</far><horizontal_fov>1.0</horizontal_fov>"
        "<aspect_ratio>2</aspect_ratio></logical_camera>"
    )
    simulator = drone(bare("logical_camera", inside), spawn=Spawn(z=1.0, yaw=np.pi / 2))
    for name, place in {
        "ahead": (0.5, 3.0, 1.5),
        "beside": (2.5, 3.0, 1.5),
        "far": (0, 6.0, 1.5),
        "high": (0, 3, 2.8),
    }.items():
        simulator.world.spawn("unit_box", place, name=name)
    message = heard(simulator, "/t", 0.02)[-1]
    (model,) = message.model
    assert model.name == "ahead"
    assert three(model.pose.position) == pytest.approx((3.0, -0.5, 0.0), abs=1e-9)
    assert three(message.pose.position) == pytest.approx((0, 0, 1.5), abs=1e-9)
    assert four(message.pose.orientation) == pytest.approx((0, 0, np.sqrt(0.5), np.sqrt(0.5)), abs=1e-9)


# hector


def test_drift_has_its_deviation_and_its_time_constant() -> None:
    period, frequency = 0.1, 0.5
    error = Drifting(np.zeros(500), np.full(500, 2.0), np.full(500, frequency), np.zeros(500), period=period, key=7)
    late = error.at(200)
    assert late.std() == pytest.approx(2.0, rel=0.12)
    later = error.at(210)
    assert np.corrcoef(late, later)[0, 1] == pytest.approx(np.exp(-frequency * 10 * period), abs=0.1)
    assert np.array_equal(error.at(200), late)  # whatever was asked for before


def test_hectors_magnetic_field_points_north_and_down(drone) -> None:
    simulator = drone(plugins=hector("magnetic", "<updateRate>50</updateRate><inclination>60</inclination>"))
    message = heard(simulator, "/magnetic", 0.1)[-1]
    assert three(message.vector) == pytest.approx((0, 0.5, -sin(radians(60))), abs=1e-9)  # x is east, y is north
    assert message.header.frame_id == "base"
    turned = (
        "<referenceHeading>0</referenceHeading><declination>10</declination><magnitude>2</magnitude><topicName>m"
        "</topicName><useMagneticFieldMsgs>true</useMagneticFieldMsgs><robotNamespace>n</robotNamespace>"
        "<offset>0.1 0 0</offset><inclination>0</inclination>"
    )
    message = heard(drone(plugins=hector("magnetic", turned)), "/n/m", 0.1)[-1]
    field = 2 * cos(radians(10)) + 0.1, -2 * sin(radians(10)), 0  # x is north: the needle turns to the east
    assert three(message.magnetic_field) == pytest.approx(field, abs=1e-9)


def test_hectors_gps_tells_fix_and_velocity(drone) -> None:
    simulator = drone(plugins=hector("gps"), spawn=Spawn(z=5.0, twist=(3.0, 0, 0.5, 0, 0, 0)))
    fixes = heard(simulator, "/fix", 1.0)
    assert len(fixes) == 4  # Hz
    assert fixes[-1].longitude > 4.5
    assert fixes[-1].latitude == pytest.approx(52.0, abs=1e-6)
    assert fixes[-1].altitude == pytest.approx(15.5, abs=1e-6)
    velocity = heard(simulator, "/fix_velocity", 0.5)[-1].vector
    assert three(velocity) == pytest.approx((0, -3.0, 0.5), abs=1e-9)  # to the north, the west and up
    own = (
        "<referenceLatitude>10</referenceLatitude><referenceLongitude>20</referenceLongitude><referenceAltitude>7"
        "</referenceAltitude><referenceHeading>0</referenceHeading><gaussianNoise>1 2 3</gaussianNoise><topicName>gps"
        "</topicName><updateRate>100</updateRate>"
    )
    fixes = heard(drone(plugins=hector("gps", own)), "/gps", 10.0)
    off = np.array([(f.latitude - 10, f.longitude - 20, f.altitude - 7) for f in fixes])
    off[:, :2] *= radians(1) * 6378137 * np.array([1.0, cos(radians(10))])
    assert off.std(axis=0) == pytest.approx([1.0, 2.0, 3.0], rel=0.12)  # x is north, y west
    assert abs(off.mean(axis=0)) == pytest.approx([0, 0, 0], abs=5 * 3 / np.sqrt(1000))
    assert fixes[0].position_covariance[[0, 4, 8]].tolist() == [1.0, 4.0, 9.0]


def test_hectors_baro_tells_height_and_pressure(drone) -> None:
    plugin = hector("baro", "<updateRate>50</updateRate><elevation>90</elevation>")
    simulator = drone(plugins=plugin, spawn=Spawn(z=10.0))
    assert heard(simulator, "/pressure_height", 0.1)[-1].point.z == pytest.approx(10.0, abs=1e-9)
    message = heard(simulator, "/altimeter", 0.1)[-1]
    assert message.altitude == pytest.approx(100.0)
    assert message.pressure == pytest.approx(pressure(100.0) / 100.0, rel=1e-4)
    assert message.qnh == 1013.25


def test_the_imu_of_hector_measures_gravity_with_the_configured_errors(drone) -> None:
    inside = (
        "<updateRate>100</updateRate><accelOffset>0.5</accelOffset><rateGaussianNoise>0.1 0.2 0.3</rateGaussianNoise>"
    )
    simulator = drone(
        plugins=hector("imu", inside + "<yawOffset>0.3</yawOffset>"), world=WORLD.replace("0 0 0<", "0 0 -9.8<")
    )
    messages = heard(simulator, "/imu", 10.0)
    rates = np.array([three(m.angular_velocity) for m in messages])
    assert rates.std(axis=0) == pytest.approx([0.1, 0.2, 0.3], rel=0.12)
    assert three(messages[-1].linear_acceleration) == pytest.approx((0.5, 0.5, 0.5), abs=1e-6)  # it falls
    assert four(messages[-1].orientation) == pytest.approx((0, 0, sin(0.15), cos(0.15)), abs=1e-9)
    assert messages[0].angular_velocity_covariance[[0, 4, 8]] == pytest.approx([0.01, 0.04, 0.09])


def test_hectors_offset_of_roll_pitch_and_yaw_is_felt_as_a_tilt(drone) -> None:
    plugin = hector("imu", "<updateRate>100</updateRate><rpyOffset>0.01 0.02 0.3</rpyOffset>")
    message = heard(drone(plugins=plugin), "/imu", 0.1)[-1]
    assert three(message.linear_acceleration) == pytest.approx((0.02 * 9.8065, -0.01 * 9.8065, 0), abs=1e-9)
    assert four(message.orientation) == pytest.approx((0, 0, sin(0.15), cos(0.15)), abs=1e-9)


def test_gazebo_ros_imu_feels_no_gravity(drone) -> None:
    plugin = (
        '<plugin name="i" filename="libgazebo_ros_imu.so"><bodyName>eye</bodyName><topicName>imu</topicName>'
        "<updateRate>100</updateRate></plugin>"
    )
    simulator = drone(plugins=plugin, world=WORLD.replace("0 0 0<", "0 0 -9.8<"), spawn=Spawn(z=50.0, yaw=0.4))
    message = heard(simulator, "/imu", 0.5)[-1]
    assert three(message.linear_acceleration) == pytest.approx((0, 0, -9.8), abs=1e-6)
    assert four(message.orientation) == pytest.approx((0, 0, sin(0.2), cos(0.2)), abs=1e-9)


def test_hectors_sonar_is_the_nearest_of_its_rays(post) -> None:
    plugin = hector("sonar", "<offset>0.25</offset><frameId>ear</frameId>")
    inside = scan(11, -0.2, 0.2, rings=3, spread=0.1)
    simulator = post(f'<sensor name="s" type="ray">{inside}{plugin}</sensor>')
    messages = heard(simulator, "/sonar", 1.0)
    assert len(messages) == 10  # Hz, where nothing is written
    message = messages[-1]
    assert message.range == pytest.approx(3.25)
    assert message.field_of_view == pytest.approx(0.2)
    assert (message.radiation_type, message.header.frame_id) == (0, "ear")
    assert (message.min_range, message.max_range) == (0.1, 30.0)


@pytest.mark.parametrize(
    ("sensors", "plugins", "reported"),
    [
        ("", hector("gps", "<bodyName>bse</bodyName>"), "`bse`, which is not a link; did you mean `base`?"),
        ("", hector("gps", "<drift>-1</drift>"), "<drift> is `-1`; it must be 0 or greater"),
        ("", hector("gps", "<drift>1 2</drift>"), "<drift> is `1 2`; it must be 3 finite numbers"),
        ("", '<plugin name="p" filename="libgazebo_ros_imu.so"/>', "gazebo_ros_imu has no <bodyName>"),
        (bare("logical_camera", "<logical_camera><near>2</near></logical_camera>"), "", "2 m to 1 m, is empty"),
    ],
)  # fmt: skip
def test_what_makes_no_sense_is_left_out_by_name(drone, sensors: str, plugins: str, reported: str) -> None:
    notes: list[str] = []
    drone(sensors, plugins, note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert contains(note, reported)
    assert "drone.urdf:1:" in note
