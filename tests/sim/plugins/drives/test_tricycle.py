"""The tricycle drive: one wheel steers and drives; angular.z is the steering angle."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import TF
from urdfkit.sim import Simulator, Spawn

BASE, TRACK = 0.8, 0.5

WHEEL = """
  <link name="{name}_wheel">
    <collision><origin rpy="1.5707963267948966 0 0"/>
      <geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
    <inertial><mass value="0.5"/><inertia ixx="0.0015" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.0015"/></inertial>
  </link>
  <joint name="{name}_wheel_joint" type="continuous">
    <parent link="{parent}"/><child link="{name}_wheel"/><origin xyz="{xyz}"/><axis xyz="0 1 0"/>
  </joint>
"""
ROBOT = """<robot name="trike">
  <link name="base_link">
    <inertial><origin xyz="0.25 0 0.1"/><mass value="8"/>
      <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.4" iyz="0" izz="0.5"/></inertial>
  </link>
  <link name="fork">
    <inertial><mass value="0.3"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
  </link>
  <joint name="front_steering_joint" type="revolute">
    <parent link="base_link"/><child link="fork"/><origin xyz="0.8 0 0.1"/><axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="100" velocity="10"/>
  </joint>
  {wheels}
  <gazebo><plugin name="trike_drive" filename="libgazebo_ros_tricycle_drive.so">
{parameters}
  </plugin></gazebo>
</robot>
"""
ROS_1 = """<actuatedWheelDiameter>0.2</actuatedWheelDiameter><encoderWheelDiameter>0.2</encoderWheelDiameter>
<encoderWheelSeparation>0.5</encoderWheelSeparation>"""
ROS_2 = """<actuated_wheel_diameter>0.2</actuated_wheel_diameter><encoder_wheel_diameter>0.2</encoder_wheel_diameter>
<wheel_separation>0.5</wheel_separation><max_wheel_torque>5</max_wheel_torque>"""
SPELLED = {"ros1": ROS_1, "ros2": ROS_2}
ENCODER = {"ros1": "<odometrySource>encoder</odometrySource>", "ros2": "<odometry_source>0</odometry_source>"}
SLOW = {"ros1": "<steeringSpeed>0.5</steeringSpeed>", "ros2": "<max_steering_speed>0.5</max_steering_speed>"}
GENERATIONS = ("ros1", "ros2")
IN_THE_AIR: dict[str, Any] = {"fixed_base": True, "spawn": Spawn(z=1.0)}

Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Make a simulator of a tricycle whose root link is between its rear wheels."""

    def build(generation: str = "ros1", parameters: str = "", *, sizes: str = "", **options: Any) -> Simulator:
        wheels = WHEEL.format(name="front", parent="fork", xyz="0 0 0")
        for side, y in (("left", TRACK / 2), ("right", -TRACK / 2)):
            wheels += WHEEL.format(name=side, parent="base_link", xyz=f"0 {y} 0.1")
        path = tmp_path / "trike.urdf"
        path.write_text(ROBOT.format(wheels=wheels, parameters=parameters + (sizes or SPELLED[generation])))
        return Simulator(path, **options)

    return build


def yaw(simulator: Simulator) -> float:
    pose = simulator.state.base_pose
    return 2 * math.atan2(pose[5], pose[6])


def settle(simulator: Simulator, v: float, angle: float, seconds: float = 1.0) -> None:
    for part in range(1, 11):
        simulator.command((v * part / 10, 0, 0), (0, 0, angle * part / 10))
        simulator.run(0.1)
    simulator.run(seconds)


@pytest.mark.parametrize("angle", [-0.6, 0.3])
@pytest.mark.parametrize("generation", GENERATIONS)
def test_it_moves_as_a_bicycle(make: Make, generation: str, angle: float) -> None:
    simulator = make(generation)
    settle(simulator, 0.5, angle)
    before = yaw(simulator)
    simulator.run(1.0)
    rate = math.remainder(yaw(simulator) - before, 2 * math.pi)
    # The front wheel rolls at v; the middle of the rear axle at v·cos(angle).
    assert rate == pytest.approx(0.5 * math.sin(angle) / BASE, rel=5e-3)
    assert math.hypot(*simulator.state.base_velocity[:2]) == pytest.approx(0.5 * math.cos(angle), rel=5e-3)
    assert simulator.state.position("front_steering_joint") == pytest.approx(angle, abs=1e-6)


@pytest.mark.parametrize("generation", GENERATIONS)
def test_encoders_see_what_the_wheels_roll(make: Make, generation: str) -> None:
    simulator = make(generation, ENCODER[generation], spawn=Spawn(x=2.0, yaw=1.0))
    settle(simulator, 0.4, 0.5, 4.0)
    position, quaternion = simulator.odometry()["odom"]
    pose = simulator.state.base_pose
    dx, dy = pose[0] - 2.0, pose[1]
    assert position[0] == pytest.approx(dx * math.cos(1.0) + dy * math.sin(1.0), abs=0.02)
    assert position[1] == pytest.approx(dy * math.cos(1.0) - dx * math.sin(1.0), abs=0.02)
    turned = math.remainder(2 * math.atan2(quaternion[2], quaternion[3]) - (yaw(simulator) - 1.0), 2 * math.pi)
    assert turned == pytest.approx(0, abs=0.02)


@pytest.mark.parametrize("generation", GENERATIONS)
def test_the_steering_is_put_in_place_within_an_update(make: Make, generation: str) -> None:
    simulator = make(generation, **IN_THE_AIR)
    simulator.command((0, 0, 0), (0, 0, 0.7))
    simulator.run(0.012)  # one update turns it, the next one stops it
    assert simulator.state.position("front_steering_joint") == pytest.approx(0.7, abs=1e-9)
    simulator.command((0, 0, 0), (0, 0, 3.0))  # beyond the right angle, and the joint's limit
    simulator.run(0.1)
    assert simulator.state.position("front_steering_joint") == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("angle", [0.4, -0.4])
@pytest.mark.parametrize("generation", GENERATIONS)
def test_steering_speed(make: Make, generation: str, angle: float) -> None:
    simulator = make(generation, SLOW[generation], **IN_THE_AIR)
    simulator.command((1.0, 0, 0), (0, 0, angle))
    simulator.run(0.5)
    assert simulator.state.position("front_steering_joint") == pytest.approx(math.copysign(0.25, angle), abs=2e-3)
    simulator.run(1.0)
    assert simulator.state.position("front_steering_joint") == pytest.approx(angle, abs=0.011)
    assert simulator.state.velocity("front_steering_joint") == pytest.approx(0, abs=1e-9)


@pytest.mark.parametrize(
    ("generation", "tags"),
    [
        ("ros1", "<wheelAcceleration>4</wheelAcceleration><wheelDeceleration>8</wheelDeceleration>"),
        (
            "ros2",
            "<max_wheel_acceleration>4</max_wheel_acceleration><max_wheel_deceleration>8</max_wheel_deceleration>",
        ),
    ],
)
def test_wheel_acceleration_is_of_the_rotation(make: Make, generation: str, tags: str) -> None:
    simulator = make(generation, tags, **IN_THE_AIR)
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.state.velocity("front_wheel_joint") == pytest.approx(4.0, abs=0.05)
    simulator.run(2.0)
    assert simulator.state.velocity("front_wheel_joint") == pytest.approx(10.0, abs=0.011)
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(0.5)
    assert simulator.state.velocity("front_wheel_joint") == pytest.approx(6.0, abs=0.1)


def test_without_deceleration_the_acceleration_counts(make: Make) -> None:
    simulator = make("ros1", "<wheelAcceleration>4</wheelAcceleration>", **IN_THE_AIR)
    simulator.command((0.2, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(0.25)
    assert simulator.state.velocity("front_wheel_joint") == pytest.approx(1.0, abs=0.06)


def test_torque_limit(make: Make) -> None:
    simulator = make("ros1", "<wheelTorque>0.05</wheelTorque>")
    simulator.command((2.0, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    # 0.05 N·m / 0.1 m on m + 3·I/r² = 9.8 + 0.75 kg
    assert simulator.state.base_velocity[0] == pytest.approx(0.5 / 10.55, rel=0.01)


def test_a_command_holds_until_the_next_one(make: Make) -> None:
    simulator = make()
    settle(simulator, 0.3, 0.0, 4.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.3, abs=1e-6)


def test_ros_1_topics_frames_and_states(make: Make) -> None:
    tags = "<publishWheelTF>true</publishWheelTF><publishWheelJointState>true</publishWheelJointState>"
    simulator = make("ros1", tags)
    assert simulator.command_topics == ("/trike/cmd_vel",)
    seen: list[Any] = []
    simulator.subscribe("/tf", TF, seen.append)
    simulator.command((0.5, 0, 0), (0, 0, 0.2))
    simulator.run(1.0)
    message = simulator.bus.latest("/trike/odom")
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_link")
    assert message.pose.covariance[::7] == pytest.approx([1e-5, 1e-5, 1e12, 1e12, 1e12, 1e-3])
    assert message.pose.pose.position.x == simulator.state.base_pose[0]
    states = simulator.bus.latest("/trike/joint_states")
    assert states.name == ["front_steering_joint", "front_wheel_joint", "left_wheel_joint", "right_wheel_joint"]
    assert states.position[0] == pytest.approx(0.2)
    assert states.velocity[1] == pytest.approx(5.0)
    assert len(states.effort) == 4
    links = {(link.header.frame_id, link.child_frame_id) for tf in seen for link in tf.transforms}
    # Its transforms have the joints' names where links' are due.
    assert {("odom", "base_link"), ("base_link", "front_steering_joint"), ("fork", "front_wheel_joint")} <= links


def test_ros_2_publishes_what_it_is_told(make: Make) -> None:
    silent = make("ros2")
    assert silent.command_topics == ("/cmd_vel",)
    silent.run(0.1)
    assert "/odom" not in {topic.name for topic in silent.bus.topics}
    extra = """<ros><namespace>/r</namespace><remapping>cmd_vel:=go</remapping></ros><publish_odom>true</publish_odom>
    <update_rate>20</update_rate>"""
    simulator = make("ros2", extra)
    simulator.run(1.0)
    assert simulator.command_topics == ("/r/go",)
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert counts["/r/odom"] == 20


def test_the_default_torque_of_ros_2_is_small(make: Make) -> None:
    simulator = make("ros2", sizes=ROS_2.replace("<max_wheel_torque>5</max_wheel_torque>", ""))
    simulator.command((5.0, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.state.base_velocity[0] == pytest.approx(1.5 / 10.55, rel=0.01)


@pytest.mark.parametrize(
    ("extra", "reported"),
    [
        ("<steeringJoint>front_steer_joint</steeringJoint>", "no joint `front_steer_joint` in robot `trike`; did you"),
        ("<encoderWheelSeparation>0</encoderWheelSeparation>", "<encoderWheelSeparation> is `0`; it must be a number"),
        ("<actuatedWheelDiameter>-1</actuatedWheelDiameter>", "<actuatedWheelDiameter> is `-1`; it must be a number"),
        ("<steeringSpeed>-1</steeringSpeed>", "<steeringSpeed> is `-1`; it must be a number, zero or greater"),
        ("<odometrySource>gps</odometrySource>", "<odometrySource> is `gps`; it must be `encoder` or `world`"),
    ],
)
def test_wrong_parameters_are_named_with_their_place(make: Make, extra: str, reported: str) -> None:
    with pytest.raises(SimulationError) as caught:
        make("ros1", extra, strict=True)
    assert reported in str(caught.value)
    assert "trike.urdf:" in str(caught.value)


def test_after_a_reset_all_is_as_at_the_start(make: Make) -> None:
    def ride(simulator: Simulator) -> tuple[bytes, Any]:
        settle(simulator, 0.4, 0.3)
        return simulator.state.q.tobytes(), simulator.odometry()

    simulator = make("ros1", ENCODER["ros1"] + SLOW["ros1"] + "<wheelAcceleration>8</wheelAcceleration>")
    first = ride(simulator)
    simulator.reset()
    assert ride(simulator) == first
