"""IMU and true poses: gravity at rest, free fall, turning rates, noise, and the pose the state has."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sim.plugins.sensors.conftest import heard
from tests.suggestions import contains
from urdfkit.description import load
from urdfkit.sim import Simulator, Spawn

ROS_1 = '<plugin name="imu" filename="libgazebo_ros_imu_sensor.so"><updateRateHZ>100</updateRateHZ>{}</plugin>'
ROS_2 = '<plugin name="imu" filename="libgazebo_ros_imu_sensor.so"><ros><namespace>n</namespace></ros></plugin>'
NOISE = """<imu><angular_velocity><x><noise type="gaussian"><stddev>0.01</stddev></noise></x></angular_velocity>
<linear_acceleration><z><noise type="gaussian"><mean>0.5</mean><stddev>0.2</stddev></noise></z></linear_acceleration>
</imu>"""


def imu(plugin: str = "", inside: str = "") -> str:
    return f'<sensor name="imu" type="imu"><update_rate>100</update_rate>{inside}{plugin}</sensor>'


@pytest.fixture
def brick(tmp_path: Path) -> Callable[..., Any]:
    """Return what makes a simulator of a free brick with sensors at a corner, in the void unless told otherwise."""

    def make(sensors: str, *, more: str = "", world: str = "void", **options: Any) -> Simulator:
        (tmp_path / "brick.urdf").write_text(
            '<robot name="brick"><link name="base"><inertial><mass value="2"/><inertia ixx="0.1" iyy="0.1" izz="0.1" '
            'ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry><box size="0.4 0.4 0.2"/></geometry></collision>'
            '</link><link name="corner"/><joint name="j" type="fixed"><parent link="base"/><child link="corner"/>'
            '<origin xyz="0.3 0 0" rpy="0 0 1.5707963267948966"/></joint>'
            f'<gazebo reference="corner">{sensors}</gazebo><gazebo>{more}</gazebo></robot>'
        )
        return Simulator(load(tmp_path / "brick.urdf"), world=world, note=lambda _: None, **options)

    return make


def three(vector) -> tuple[float, float, float]:
    return vector.x, vector.y, vector.z


def four(quaternion) -> tuple[float, ...]:
    return quaternion.x, quaternion.y, quaternion.z, quaternion.w


def test_at_rest_it_feels_the_ground_push_against_gravity(brick) -> None:
    simulator = brick(imu(ROS_1.format("")), world="empty")
    message = heard(simulator, "/brick/imu_data", 0.5)[-1]
    assert three(message.linear_acceleration) == pytest.approx(
        (0, 0, -simulator.world.description.gravity[2]), abs=1e-6
    )
    assert three(message.angular_velocity) == pytest.approx((0, 0, 0), abs=1e-6)
    assert four(message.orientation) == pytest.approx((0, 0, np.sqrt(0.5), np.sqrt(0.5)), abs=1e-6)
    assert message.header.frame_id == "corner"


@pytest.mark.parametrize(
    ("inside", "frame"),
    [("", "corner"), ("<bodyName>base</bodyName>", "base"), ("<bodyName>base</bodyName><frameName>f</frameName>", "f")],
)
def test_it_names_its_frame_as_it_is_told(brick, inside: str, frame: str) -> None:
    message = heard(brick(imu(ROS_1.format(inside)), spawn=Spawn(z=9.0)), "/brick/imu_data", 0.1)[-1]
    assert message.header.frame_id == frame


def test_in_free_fall_it_feels_nothing(brick) -> None:
    message = heard(brick(imu(ROS_2), gravity=(0, 0, -9.81), spawn=Spawn(z=50.0)), "/n/imu/out", 0.2)[-1]
    assert three(message.linear_acceleration) == pytest.approx((0, 0, 0), abs=1e-6)


def test_turning_it_reads_its_rates_and_the_pull_to_the_axis(brick) -> None:
    simulator = brick(imu(ROS_2), gravity=(0, 0, 0), spawn=Spawn(z=5.0, twist=(0, 0, 0, 0, 0, 3.0)))
    message = heard(simulator, "/n/imu/out", 0.2)[-1]
    assert three(message.angular_velocity) == pytest.approx((0, 0, 3.0), abs=1e-9)
    # The corner is 0.3 m from the axis, along what is -y in its own frame; felt is the mean over one step.
    assert three(message.linear_acceleration) == pytest.approx((0.0, 0.3 * 9.0, 0.0), abs=0.01)


def test_it_comes_at_its_rate_and_costs_two_stops_each(brick) -> None:
    messages = heard(brick(imu(ROS_2), spawn=Spawn(z=50.0)), "/n/imu/out", 1.0)
    stamps = [m.header.stamp.sec + 1e-9 * m.header.stamp.nanosec for m in messages]
    assert np.allclose(stamps, np.arange(1, 101) * 0.01)


def test_a_message_nobody_waited_for_can_be_had(brick) -> None:
    simulator = brick(imu(ROS_2), world="empty")
    simulator.run(0.5)
    simulator.run(0.01)
    felt = simulator.bus.latest("/n/imu/out").linear_acceleration
    assert three(felt) == pytest.approx((0, 0, -simulator.world.description.gravity[2]), abs=1e-6)


def test_gz_sims_orientation_is_relative_to_the_start(brick) -> None:
    simulator = brick(imu(), gravity=(0, 0, 0), spawn=Spawn(z=5.0, yaw=0.7, twist=(0, 0, 0, 0, 0, 1.0)))
    topic = "/world/void/model/brick/link/corner/sensor/imu/imu"
    messages = heard(simulator, topic, 0.5)
    angles = [2 * np.arctan2(m.orientation.z, m.orientation.w) for m in messages]
    assert np.diff(angles) == pytest.approx(np.full(len(angles) - 1, 0.01), abs=1e-6)
    assert angles[0] == pytest.approx(0.0, abs=0.011)


def test_noise_is_what_is_written_and_told_in_the_covariances(brick) -> None:
    simulator = brick(imu(ROS_2, NOISE), gravity=(0, 0, 0), spawn=Spawn(z=5.0))
    messages = heard(simulator, "/n/imu/out", 20.0)
    z = np.array([m.linear_acceleration.z for m in messages])
    x = np.array([m.angular_velocity.x for m in messages])
    assert z.mean() == pytest.approx(0.5, abs=5 * 0.2 / np.sqrt(2000))
    assert z.std() == pytest.approx(0.2, rel=0.08)
    assert x.std() == pytest.approx(0.01, rel=0.08)
    assert {m.linear_acceleration.x for m in messages} == {0.0}
    assert messages[0].linear_acceleration_covariance[8] == pytest.approx(0.04)
    assert messages[0].angular_velocity_covariance[0] == pytest.approx(1e-4)


def test_in_ros_1_the_plugin_adds_its_noise_to_the_sensors(brick) -> None:
    simulator = brick(imu(ROS_1.format("<gaussianNoise>0.1</gaussianNoise>"), NOISE), gravity=(0, 0, 0))
    messages = heard(simulator, "/brick/imu_data", 20.0)
    x, z = (np.array([getattr(m.linear_acceleration, axis) for m in messages]) for axis in "xz")
    assert z.mean() == pytest.approx(0.5, abs=5 * 0.23 / np.sqrt(2000))
    assert (x.std(), z.std()) == (pytest.approx(0.1, rel=0.08), pytest.approx(np.hypot(0.1, 0.2), rel=0.08))
    assert messages[0].linear_acceleration_covariance[8] == pytest.approx(0.01)


@pytest.mark.parametrize(
    ("plugin", "topic"),
    [
        ("<bodyName>corner</bodyName><topicName>truth</topicName><gaussianNoise>0</gaussianNoise>", "/truth"),
        ("<ros><remapping>odom:=/t</remapping></ros><body_name>corner</body_name><update_rate>50</update_rate>", "/t"),
    ],
)
def test_p3d_tells_where_a_link_is_and_how_it_moves(brick, plugin: str, topic: str) -> None:
    written = f'<plugin name="p" filename="libgazebo_ros_p3d.so">{plugin}</plugin>'
    start = Spawn(x=1.0, y=2.0, z=50.0, yaw=0.5, twist=(0.3, 0, 0, 0, 0, 2.0))
    simulator = brick("", more=written, spawn=start, gravity=(0, 0, 0))
    message = heard(simulator, topic, 0.1)[-1]
    x, y = 1.03 + 0.3 * np.cos(0.7), 2 + 0.3 * np.sin(0.7)
    assert three(message.pose.pose.position) == pytest.approx((x, y, 50.0), abs=1e-4)
    speed = (0.3 - 0.6 * np.sin(0.7), 0.6 * np.cos(0.7), 0)
    assert three(message.twist.twist.linear) == pytest.approx(speed, abs=1e-4)
    assert three(message.twist.twist.angular) == pytest.approx((0, 0, 2.0), abs=1e-9)
    assert (message.header.frame_id, message.child_frame_id) == ("world", "corner")


def test_p3d_tells_poses_as_another_link_sees_them(brick) -> None:
    plugin = "<bodyName>base</bodyName><topicName>seen</topicName><frameName>corner</frameName>"
    start = Spawn(x=1.0, y=2.0, z=50.0, yaw=0.5, twist=(0.3, 0, 0, 0, 0, 2.0))
    simulator = brick("", more=f'<plugin name="p" filename="libgazebo_ros_p3d.so">{plugin}</plugin>', spawn=start)
    message = heard(simulator, "/seen", 0.1)[-1]
    assert message.header.frame_id == "corner"
    assert three(message.pose.pose.position) == pytest.approx((0, 0.3, 0), abs=1e-9)  # they are fixed to each other
    assert three(message.twist.twist.linear) == pytest.approx((0, 0, 0), abs=1e-9)
    assert three(message.twist.twist.angular) == pytest.approx((0, 0, 0), abs=1e-9)
    assert four(message.pose.pose.orientation) == pytest.approx((0, 0, -np.sqrt(0.5), np.sqrt(0.5)), abs=1e-9)


@pytest.mark.parametrize(
    ("plugin", "reported"),
    [
        ("<bodyName>cornr</bodyName><topicName>t</topicName>", "`cornr`, which is not a link; did you mean `corner`?"),
        ("<bodyName>base</bodyName>", "gazebo_ros_p3d has no <topicName>"),
        (
            "<bodyName>base</bodyName><topicName>t</topicName><frameName>bse</frameName>",
            "is `bse`; did you mean `base`?",
        ),
    ],
)
def test_a_pose_that_cannot_be_told_is_left_out_by_name(tmp_path: Path, brick, plugin: str, reported: str) -> None:
    notes: list[str] = []
    written = f'<plugin name="p" filename="libgazebo_ros_p3d.so">{plugin}</plugin>'
    robot = brick("", more=written).robot
    Simulator(robot, world="void", note=notes.append)
    (note,) = [each for each in notes if "is ignored" in each]
    assert contains(note, reported)
    assert "; sensor `p` is ignored" in note
