"""Ackermann steering in ROS 2 (angular.z is the angle) and in gz sim (angular.z is the yaw rate)."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import SimulationError
from urdfkit.messages import TF, from_fields
from urdfkit.sim import Simulator, Spawn

RADIUS, TRACK, BASE = 0.1, 0.4, 0.6

WHEEL = """
  <link name="{name}_wheel">
    <collision><origin rpy="1.5707963267948966 0 0"/>
      <geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
    <inertial><mass value="0.5"/><inertia ixx="0.0015" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.0015"/></inertial>
  </link>
  <joint name="{name}_joint" type="continuous">
    <parent link="{parent}"/><child link="{name}_wheel"/><origin xyz="{xyz}"/><axis xyz="0 1 0"/>
  </joint>
"""
KNUCKLE = """
  <link name="{side}_knuckle">
    <inertial><mass value="0.3"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
  </link>
  <joint name="{side}_steering_joint" type="revolute">
    <parent link="base"/><child link="{side}_knuckle"/><origin xyz="0.6 {y} 0.1"/><axis xyz="0 0 1"/>
    <limit lower="-0.8" upper="0.8" effort="{effort}" velocity="10"/>
  </joint>
"""
HAND_WHEEL = """
  <link name="hand_wheel">
    <inertial><mass value="0.2"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
  </link>
  <joint name="steering_wheel_joint" type="continuous">
    <parent link="base"/><child link="hand_wheel"/><origin xyz="0.3 0.1 0.3"/><axis xyz="0 0 1"/>
  </joint>
"""
ROBOT = """<robot name="car">
  <link name="base">
    <inertial><origin xyz="0.3 0 0.12"/><mass value="10"/>
      <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.6"/></inertial>
  </link>
  {parts}
  <gazebo><plugin name="{name}" filename="{filename}">
{parameters}
  </plugin></gazebo>
</robot>
"""
GAINS = """<left_steering_pid_gain>35 0 1.75</left_steering_pid_gain>
<right_steering_pid_gain>35 0 1.75</right_steering_pid_gain>
<linear_velocity_pid_gain>1.5 2 0</linear_velocity_pid_gain><linear_velocity_i_range>-20 20</linear_velocity_i_range>
<max_steer>0.7</max_steer>"""
JOINTS = """<left_joint>rear_left_joint</left_joint><right_joint>rear_right_joint</right_joint>
<left_steering_joint>left_steering_joint</left_steering_joint>
<right_steering_joint>right_steering_joint</right_steering_joint>"""
SIZES = """<wheel_separation>0.4</wheel_separation><kingpin_width>0.4</kingpin_width><wheel_base>0.6</wheel_base>
<wheel_radius>0.1</wheel_radius><steering_limit>0.6</steering_limit>"""
GZ = JOINTS + SIZES + "<steer_p_gain>20</steer_p_gain><max_acceleration>2</max_acceleration>"
CLASSIC, SYSTEM = "libgazebo_ros_ackermann_drive.so", "gz-sim-ackermann-steering-system"

Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Make a simulator of a car."""

    def build(
        parameters: str = GAINS, filename: str = CLASSIC, *, effort: float = 200.0, hand_wheel: bool = False,
        replaced: tuple[str, str] = ("", ""), **options: Any
    ) -> Simulator:  # fmt: skip
        parts = ""
        for side, y in (("left", TRACK / 2), ("right", -TRACK / 2)):
            parts += KNUCKLE.format(side=side, y=y, effort=effort)
            parts += WHEEL.format(name=f"front_{side}", parent=f"{side}_knuckle", xyz="0 0 0")
            parts += WHEEL.format(name=f"rear_{side}", parent="base", xyz=f"0 {y} 0.1")
        name = "gz::sim::systems::AckermannSteering" if filename == SYSTEM else "drive"
        parts += HAND_WHEEL if hand_wheel else ""
        text = ROBOT.format(parts=parts, name=name, filename=filename, parameters=parameters)
        path = tmp_path / "car.urdf"
        path.write_text(text.replace(*replaced) if replaced[0] else text)
        return Simulator(path, **options)

    return build


def yaw(simulator: Simulator) -> float:
    pose = simulator.state.base_pose
    return 2 * math.atan2(pose[5], pose[6])


def settle(simulator: Simulator, v: float, turn: float, seconds: float = 2.0) -> None:
    for part in range(1, 11):
        simulator.command((v * part / 10, 0, 0), (0, 0, turn))
        simulator.run(0.1)
    simulator.run(seconds)


def turn_rate(simulator: Simulator) -> float:
    before = yaw(simulator)
    simulator.run(0.5)
    return math.remainder(yaw(simulator) - before, 2 * math.pi) / 0.5


# ROS 2


@pytest.mark.parametrize("angle", [-0.4, 0.25, 0.5])
def test_wheels_circle_the_same_point(make: Make, angle: float) -> None:
    simulator = make()
    settle(simulator, 0.6, angle, 6.0)
    radius = BASE / math.tan(angle)
    state = simulator.state
    assert state.position("left_steering_joint") == pytest.approx(math.atan(BASE / (radius - TRACK / 2)), abs=5e-3)
    assert state.position("right_steering_joint") == pytest.approx(math.atan(BASE / (radius + TRACK / 2)), abs=5e-3)
    rate = turn_rate(simulator)
    speed = math.hypot(*state.base_velocity[:2])
    assert rate == pytest.approx(speed * math.tan(angle) / BASE, rel=0.02)


def test_it_reaches_the_speed(make: Make) -> None:
    simulator = make()
    settle(simulator, 0.8, 0.0, 5.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.8, rel=0.01)
    assert simulator.state.base_pose[1] == pytest.approx(0, abs=1e-3)
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(5.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0, abs=0.02)


def test_speed_and_angle_are_limited(make: Make) -> None:
    simulator = make(GAINS + "<max_speed>0.5</max_speed>")
    settle(simulator, 3.0, 2.0, 4.0)
    state = simulator.state
    assert state.velocity("rear_right_joint") * RADIUS == pytest.approx(0.5, rel=0.03)
    radius = BASE / math.tan(0.7)
    assert state.position("right_steering_joint") == pytest.approx(math.atan2(BASE, radius + TRACK / 2), abs=5e-3)


def test_an_undamped_steering_keeps_its_velocity_limit(make: Make) -> None:
    """Gazebo Classic exerts no effort in the direction of a motion that is faster than ``<limit velocity>``.

    One step can exceed the limit by the effort times the step over the inertia.
    """
    gains = GAINS.replace("35 0 1.75", "35 0 0")
    limit, step = 0.5, 0.001
    simulator = make(gains, replaced=('velocity="10"', f'velocity="{limit}"'))
    simulator.command((0, 0, 0), (0, 0, 0.4))
    speeds = []
    for _ in range(400):
        simulator.step()
        speeds.append(abs(simulator.state.velocity("left_steering_joint")))
    inertia = 0.002 + 0.0015  # knuckle and wheel about the hinge
    assert limit < max(speeds) < limit + 35 * 0.6 * step / inertia
    assert simulator.state.position("left_steering_joint") > 0.1


def test_backwards_it_steers_the_other_way(make: Make) -> None:
    simulator = make()
    settle(simulator, -0.5, 0.3)
    assert simulator.state.position("left_steering_joint") < -0.2
    assert turn_rate(simulator) > 0.1


def test_efforts_act_one_step_in_each_period(make: Make) -> None:
    # Fixed in the air, the rear wheel gets p·(target / radius) for a tenth of the time; the limit comes first.
    gains = "<linear_velocity_pid_gain>0.01 0 0</linear_velocity_pid_gain>"
    simulator = make(gains, fixed_base=True, spawn=Spawn(z=1.0), note=lambda text: None)
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(0.01)
    assert simulator.state.velocity("rear_right_joint") == pytest.approx(0.01 * 10 * 0.001 / 0.0025)
    assert simulator.state.velocity("rear_left_joint") == simulator.state.velocity("rear_right_joint")
    assert simulator.state.velocity("front_left_joint") == 0.0
    limited = make("<left_steering_pid_gain>1e6 0 0</left_steering_pid_gain>", effort=0.5, fixed_base=True,
                   spawn=Spawn(z=1.0), note=lambda text: None)  # fmt: skip
    limited.command((0, 0, 0), (0, 0, 0.5))
    limited.run(0.01)
    assert limited.state.velocity("left_steering_joint") == pytest.approx(0.5 * 0.001 / 0.0035, rel=1e-6)


def test_without_gains_it_does_nothing_and_says_so(make: Make) -> None:
    notes: list[str] = []
    simulator = make("", note=notes.append)
    simulator.command((1, 0, 0), (0, 0, 0.5))
    simulator.run(1.0)
    assert simulator.state.base_velocity[:3] == pytest.approx((0, 0, 0), abs=1e-6)
    assert [note.partition(": ")[2] for note in notes] == [
        "<linear_velocity_pid_gain> is 0 0 0, so the robot does not drive",
        "<right_steering_pid_gain> is 0 0 0, so the robot does not steer with its right wheel",
        "<left_steering_pid_gain> is 0 0 0, so the robot does not steer with its left wheel",
    ]


def test_the_hand_wheel_turns_along(make: Make) -> None:
    simulator = make(GAINS + "<max_steering_angle>7</max_steering_angle>", hand_wheel=True)
    settle(simulator, 0.3, 0.3)
    state = simulator.state
    mean = (state.position("left_steering_joint") + state.position("right_steering_joint")) / 2
    assert state.position("steering_wheel_joint") == pytest.approx(10 * mean, rel=0.01)


def test_topics_frames_and_distance(make: Make) -> None:
    extra = """<ros><namespace>/r</namespace><remapping>cmd_vel:=cmd</remapping></ros><update_rate>50</update_rate>
    <publish_odom>true</publish_odom><publish_odom_tf>true</publish_odom_tf><publish_wheel_tf>true</publish_wheel_tf>
    <publish_distance>true</publish_distance><publish_steerangle>true</publish_steerangle><covariance_y>0.2</covariance_y>"""
    simulator = make(GAINS + extra)
    assert simulator.command_topics == ("/r/cmd",)
    seen: list[Any] = []
    simulator.subscribe("/tf", TF, seen.append)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert (counts["/r/odom"], counts["/r/distance"], counts["/r/steerangle"]) == (50, 50, 50)
    message = simulator.bus.latest("/r/odom")
    assert message.pose.pose.position.x == simulator.state.base_pose[0]
    assert message.pose.covariance[7] == message.twist.covariance[7] == 0.2
    assert simulator.bus.latest("/r/distance").data == pytest.approx(simulator.state.base_pose[0], rel=0.02)
    links = {(link.header.frame_id, link.child_frame_id) for tf in seen for link in tf.transforms}
    assert {("odom", "base_footprint"), ("base", "left_knuckle"), ("left_knuckle", "front_left_wheel")} <= links
    assert {("base_footprint", "left_knuckle"), ("base_footprint", "front_left_wheel")} <= links  # the plugin's
    simulator.command((0.5, 0, 0), (0, 0, 0.3))
    simulator.run(1.0)
    turned = [simulator.state.position(f"{side}_steering_joint") for side in ("left", "right")]
    assert simulator.bus.latest("/r/steerangle").data == pytest.approx(sum(turned) / 2)


def test_by_default_it_publishes_nothing(make: Make) -> None:
    simulator = make()
    simulator.run(0.1)
    names = {topic.name for topic in simulator.bus.topics}
    assert not names & {"/odom", "/distance"}


@pytest.mark.parametrize(
    ("extra", "replaced", "reported"),
    [
        ("<rear_left_joint>rear_lft_joint</rear_left_joint>", ("", ""), "no joint `rear_lft_joint` in robot `car`; d"),
        ("<max_steer>0</max_steer>", ("", ""), "<max_steer> is `0`; it must be a number greater than zero"),
        ("<left_steering_pid_gain>1 2</left_steering_pid_gain>", ("", ""), "is `1 2`; it must be 3 finite numbers"),
        (
            "",
            ('<cylinder radius="0.1" length="0.04"/>', '<box size="0.2 0.04 0.2"/>'),
            "the wheel of joint `rear_right_joint` has no radius: the first <collision> of link `rear_right_wheel`",
        ),
        ("", ('xyz="0.6 ', 'xyz="0 '), "the wheels are 0.4 m apart and the axles 0 m; both must be positive"),
    ],
)
def test_wrong_parameters_are_named_with_their_place(
    make: Make, extra: str, replaced: tuple[str, str], reported: str
) -> None:
    with pytest.raises(SimulationError) as caught:
        make(extra + GAINS, replaced=replaced, strict=True)
    assert reported in str(caught.value)
    assert "car.urdf:" in str(caught.value)


# gz sim


@pytest.mark.slow
@pytest.mark.parametrize(("v", "w"), [(0.6, 0.4), (0.6, -0.5), (-0.4, 0.3)])
def test_gz_sim_turns_at_the_rate_it_is_told(make: Make, v: float, w: float) -> None:
    simulator = make(GZ, SYSTEM)
    settle(simulator, v, w)
    assert turn_rate(simulator) == pytest.approx(w, rel=0.02)
    assert math.hypot(*simulator.state.base_velocity[:2]) == pytest.approx(abs(v), rel=0.01)


def test_gz_sim_drives_its_wheels_as_a_differential(make: Make) -> None:
    simulator = make(GZ, SYSTEM)
    settle(simulator, 0.5, 0.4)
    for side, sign in (("left", -1), ("right", 1)):
        assert simulator.state.velocity(f"rear_{side}_joint") == pytest.approx((0.5 + sign * 0.4 * TRACK / 2) / RADIUS)
    radius = 0.5 / 0.4
    for side, sign in (("left", -1), ("right", 1)):
        angle = math.atan(BASE / (radius + sign * TRACK / 2))
        assert simulator.state.position(f"{side}_steering_joint") == pytest.approx(angle, abs=1e-4)


def test_gz_sim_steers_no_tighter_than_its_limit(make: Make) -> None:
    simulator = make(GZ, SYSTEM)
    settle(simulator, 0.2, 3.0)
    tightest = BASE / math.sin(0.6)
    angle = math.atan(BASE / (tightest - TRACK / 2))
    assert simulator.state.position("left_steering_joint") == pytest.approx(angle, abs=1e-3)
    simulator.command((0, 0, 0), (0, 0, -1.0))
    simulator.run(2.0)
    assert simulator.state.position("right_steering_joint") == pytest.approx(-angle, abs=1e-3)
    simulator.command((0, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    assert simulator.state.position("right_steering_joint") == pytest.approx(0, abs=1e-3)


def test_steering_approaches_as_its_gain_says(make: Make) -> None:
    simulator = make(JOINTS + SIZES + "<steer_p_gain>2</steer_p_gain>", SYSTEM, fixed_base=True, spawn=Spawn(z=1.0))
    simulator.command((0.5, 0, 0), (0, 0, 0.4))
    simulator.run(0.5)
    target = math.atan(BASE / (0.5 / 0.4 - TRACK / 2))
    assert simulator.state.position("left_steering_joint") == pytest.approx(target * (1 - math.exp(-1)), rel=2e-3)
    bounded = make(GZ + "<steer_cmd_max>0.3</steer_cmd_max>", SYSTEM, fixed_base=True, spawn=Spawn(z=1.0))
    bounded.command((0.5, 0, 0), (0, 0, 5.0))
    bounded.run(0.5)
    assert bounded.state.position("left_steering_joint") == pytest.approx(0.15, abs=0.01)


@pytest.mark.slow
def test_odometry_of_gz_sim_follows_the_bicycle(make: Make) -> None:
    simulator = make(GZ, SYSTEM, name="c")
    settle(simulator, 0.5, 0.3, 5.0)
    position, quaternion = simulator.odometry()["c/odom"]
    pose = simulator.state.base_pose
    # It takes the mean of the two wheels' angles for the bicycle's, which is larger: 1.3 % on this curve.
    radius = 0.5 / 0.3
    mean = (math.atan(BASE / (radius - TRACK / 2)) + math.atan(BASE / (radius + TRACK / 2))) / 2
    believed = 0.5 * math.tan(mean) / BASE
    assert believed / 0.3 == pytest.approx(1.0129, abs=1e-4)
    assert position[:2] == pytest.approx(pose[:2], abs=0.06)
    turned = math.remainder(2 * math.atan2(quaternion[2], quaternion[3]) - yaw(simulator), 2 * math.pi)
    assert turned == pytest.approx(6.0 * (believed - 0.3), abs=0.02)
    message = simulator.bus.latest("/model/c/odometry")
    assert (message.header.frame_id, message.child_frame_id) == ("c/odom", "c/base")
    assert message.twist.twist.linear.x == pytest.approx(0.5, rel=1e-3)
    assert message.twist.twist.angular.z == pytest.approx(believed, rel=1e-3)
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert counts["/model/c/odometry"] == counts["/model/c/tf"] == round(simulator.t * 50)


def test_limits_of_gz_sim(make: Make) -> None:
    simulator = make(GZ + "<max_velocity>0.3</max_velocity>", SYSTEM)
    simulator.command((1.0, 0, 0), (0, 0, 0))
    simulator.run(0.1)
    assert simulator.state.velocity("rear_left_joint") * RADIUS == pytest.approx(0.2, abs=5e-3)
    simulator.run(1.0)
    assert simulator.state.velocity("rear_left_joint") * RADIUS == pytest.approx(0.3, abs=1e-6)


@pytest.mark.slow
def test_once_settled_it_rests_and_wakes_when_pushed(make: Make) -> None:
    simulator = make(GZ, SYSTEM)
    simulator.command((0.5, 0, 0), (0, 0, 0.2))
    simulator.run(3.0)
    drive = simulator._drives[0]
    assert drive.resting
    simulator.command((0.5, 0, 0), (0, 0, -0.2))
    assert not drive.resting
    simulator.run(2.0)
    assert drive.resting
    assert simulator.state.position("left_steering_joint") < -0.1


def test_steering_only_takes_angles(make: Make) -> None:
    simulator = make(JOINTS + SIZES + "<steering_only>true</steering_only><steer_p_gain>20</steer_p_gain>", SYSTEM)
    assert simulator.command_topics == ()
    angle = from_fields("std_msgs/msg/Float64", {"data": 0.4})
    simulator.bus.publish("/model/car/steer_angle", "std_msgs/msg/Float64", angle)
    simulator.run(2.0)
    radius = BASE / math.tan(0.4)
    for side, sign in (("left", -1), ("right", 1)):
        expected = math.atan(BASE / (radius + sign * TRACK / 2))
        assert simulator.state.position(f"{side}_steering_joint") == pytest.approx(expected, abs=1e-3)
    assert "/model/car/odometry" not in {topic.name for topic in simulator.bus.topics}


@pytest.mark.parametrize(
    ("parameters", "topic"),
    [("", "/model/car/cmd_vel"), ("<sub_topic>go</sub_topic>", "/model/car/go"), ("<topic>go</topic>", "/go")],
)
def test_topics_of_gz_sim(make: Make, parameters: str, topic: str) -> None:
    assert make(GZ + parameters, SYSTEM).command_topics == (topic,)


@pytest.mark.parametrize(
    ("parameters", "reported"),
    [
        (JOINTS.partition("<left_steering")[0], "no <left_steering_joint>; this drive needs at least one"),
        (JOINTS + "<wheel_base>0</wheel_base>", "<wheel_base> is `0`; it must be a number greater than zero"),
        (JOINTS + "<use_actuator_msg>true</use_actuator_msg>", "steering by actuator messages is not simulated"),
    ],
)
def test_wrong_parameters_of_gz_sim(make: Make, parameters: str, reported: str) -> None:
    with pytest.raises(SimulationError) as caught:
        make(parameters, SYSTEM, strict=True)
    assert reported in str(caught.value)
    assert "car.urdf:" in str(caught.value)


@pytest.mark.parametrize(("parameters", "filename"), [(GAINS, CLASSIC), (GZ, SYSTEM)])
def test_after_a_reset_all_is_as_at_the_start(make: Make, parameters: str, filename: str) -> None:
    def ride(simulator: Simulator) -> tuple[bytes, Any]:
        settle(simulator, 0.4, 0.3, 0.5)
        return simulator.state.q.tobytes(), simulator.odometry()

    simulator = make(parameters, filename)
    first = ride(simulator)
    simulator.reset()
    assert ride(simulator) == first
