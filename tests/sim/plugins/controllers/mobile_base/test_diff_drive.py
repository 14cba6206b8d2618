"""diff_drive_controller of ROS 1 and ROS 2: law, limits, timeout, multipliers, odometry, topics, errors."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import UrdfkitError
from urdfkit.messages import ODOMETRY, TF, TWIST, TWIST_STAMPED, from_fields, twist
from urdfkit.sim import Simulator, Spawn

Make = Callable[..., Any]

ROS_1 = """
  <transmission name="tl"><type>transmission_interface/SimpleTransmission</type><joint name="left_joint">
    <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint></transmission>
  <transmission name="tr"><type>transmission_interface/SimpleTransmission</type><joint name="right_joint">
    <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint></transmission>
  <gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>
"""

ROS_2 = """
  <ros2_control name="r" type="system"><hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="left_joint"><command_interface name="velocity"/></joint>
    <joint name="right_joint"><command_interface name="velocity"/></joint></ros2_control>
  <gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>control.yaml</parameters></plugin></gazebo>
"""

YAML_1 = """rover:
  base:
    type: diff_drive_controller/DiffDriveController
    left_wheel: left_joint
    right_wheel: [right_joint]
    pose_covariance_diagonal: [0.001, 0.002, 0, 0, 0, 0.03]
    twist_covariance_diagonal: [0.1, 0, 0, 0, 0, 0.2]
    base_frame_id: base
"""

YAML_2 = """controller_manager:
  ros__parameters:
    update_rate: 200
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters:
    left_wheel_names: [left_joint]
    right_wheel_names: [right_joint]
    wheel_separation: 0.3
    wheel_radius: 0.1
    base_frame_id: base
"""


@pytest.fixture
def make(write_rover: Callable[..., Path], tmp_path: Path) -> Make:
    def build(ros: int, more: str = "", *, yaml: str | None = None, **options: Any) -> Any:
        indent = "    "
        text = yaml or (YAML_1 if ros == 1 else YAML_2)
        text += "".join(f"{indent}{line}\n" for line in more.splitlines())
        control = tmp_path / "control.yaml"
        control.write_text(text)
        options.setdefault("note", lambda _: None)
        if ros == 1:
            options["controllers"] = [control]
        return Simulator(write_rover(ROS_1 if ros == 1 else ROS_2), **options)

    return build


def wheels(simulator: Any) -> tuple[float, float]:
    return simulator.state.velocity("left_joint"), simulator.state.velocity("right_joint")


LIFTED = {"fixed_base": True, "spawn": Spawn(z=1.0)}


@pytest.mark.parametrize("ros", [1, 2])
def test_wheels_turn_at_v_plus_minus_w_times_half_the_separation(make: Make, ros: int) -> None:
    simulator = make(ros, **LIFTED)
    simulator.command((0.5, 0, 0), (0, 0, 1.0))
    simulator.run(0.3)
    assert wheels(simulator) == pytest.approx(((0.5 - 0.15) / 0.1, (0.5 + 0.15) / 0.1))


@pytest.mark.parametrize("ros", [1, 2])
def test_without_further_commands_it_stops_after_the_timeout(make: Make, ros: int) -> None:
    simulator = make(ros, **LIFTED)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(0.49)
    assert wheels(simulator) == pytest.approx((5.0, 5.0))
    simulator.run(0.04)
    assert wheels(simulator) == pytest.approx((0.0, 0.0), abs=1e-9)
    simulator.every(0.4, lambda: simulator.command((0.5, 0, 0), (0, 0, 0)), start=simulator.t)
    simulator.run(5.0)
    assert wheels(simulator) == pytest.approx((5.0, 5.0))


def test_zero_timeout_is_none_in_ros_2(make: Make) -> None:
    simulator = make(2, "cmd_vel_timeout: 0.0", **LIFTED)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(5.0)
    assert wheels(simulator) == pytest.approx((5.0, 5.0))


LIMITS_1 = """linear:
  x: {has_velocity_limits: true, max_velocity: 0.4, has_acceleration_limits: true, max_acceleration: 1.0}
angular: {z: {has_velocity_limits: false, max_velocity: 0.1}}"""
LIMITS_2 = "linear.x.max_velocity: 0.4\nlinear.x.max_acceleration: 1.0\nangular.z.max_velocity: .nan"


@pytest.mark.parametrize(("ros", "limits"), [(1, LIMITS_1), (2, LIMITS_2)])
def test_velocity_and_acceleration_limits(make: Make, ros: int, limits: str) -> None:
    simulator = make(ros, limits + "\ncmd_vel_timeout: 100.0", **LIFTED)
    simulator.command((5.0, 0, 0), (0, 0, 0))
    simulator.run(0.2)
    assert wheels(simulator) == pytest.approx((2.0, 2.0), abs=0.06)  # 1 m/s² for 0.2 s
    simulator.run(1.0)
    assert wheels(simulator) == pytest.approx((4.0, 4.0))
    simulator.command((-5.0, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    assert wheels(simulator) == pytest.approx((-4.0, -4.0))
    simulator.command((0.0, 0, 0), (0, 0, 2.0))
    simulator.run(2.0)
    assert wheels(simulator) == pytest.approx((-3.0, 3.0))


def test_multipliers(make: Make) -> None:
    more = "wheel_separation_multiplier: 2.0\nleft_wheel_radius_multiplier: 0.5\nright_wheel_radius_multiplier: 0.25"
    simulator = make(2, more, **LIFTED)
    simulator.command((0.5, 0, 0), (0, 0, 0.5))
    simulator.run(0.2)
    assert wheels(simulator) == pytest.approx(((0.5 - 0.15) / 0.05, (0.5 + 0.15) / 0.025))


def test_odometry_is_what_the_wheels_roll(make: Make) -> None:
    simulator = make(1, "cmd_vel_timeout: 100.0")
    seen: dict[str, list[Any]] = {}
    for topic, kind in (("/rover/base/odom", ODOMETRY), ("/tf", TF)):
        simulator.subscribe(topic, kind, seen.setdefault(topic, []).append)
    for part in range(1, 101):  # gently, so that the tyres do not slip
        simulator.command((0.005 * part, 0, 0), (0, 0, 0.005 * part))
        simulator.run(0.01)
    simulator.run(9.0)
    odometry = seen["/rover/base/odom"]
    assert len(odometry) == 500
    last = odometry[-1]
    assert (last.header.frame_id, last.child_frame_id) == ("odom", "base")
    true = simulator.state.base_pose
    assert (last.pose.pose.position.x, last.pose.pose.position.y) == pytest.approx(true[:2], abs=2e-3)
    heading = 2 * math.atan2(last.pose.pose.orientation.z, last.pose.pose.orientation.w)
    assert math.remainder(heading - 2 * math.atan2(true[5], true[6]), 2 * math.pi) == pytest.approx(0, abs=5e-3)
    assert (last.twist.twist.linear.x, last.twist.twist.angular.z) == pytest.approx((0.5, 0.5), abs=1e-6)
    assert last.pose.covariance[[0, 7, 35]] == pytest.approx([0.001, 0.002, 0.03])
    assert last.twist.covariance[[0, 35]] == pytest.approx([0.1, 0.2])
    frames = [link for message in seen["/tf"] for link in message.transforms if link.child_frame_id == "base"]
    assert frames[-1].header.frame_id == "odom"
    assert frames[-1].transform.translation.x == last.pose.pose.position.x


def test_looking_at_the_odometry_changes_nothing(make: Make) -> None:
    def drive(looking: bool) -> tuple[bytes, Any]:
        simulator = make(1, "cmd_vel_timeout: 100.0")
        simulator.command((0.4, 0, 0), (0, 0, 0.7))
        for _ in range(137):
            simulator.step(7)
            if looking:
                position, _ = simulator.odometry()["odom"]
        message = simulator.bus.latest("/rover/base/odom")
        if looking:
            assert position == pytest.approx((message.pose.pose.position.x, message.pose.pose.position.y, 0), abs=0.01)
        return simulator.state.q.tobytes(), message.pose.pose

    assert drive(True) == drive(False)


def test_open_loop_odometry_is_what_was_commanded(make: Make) -> None:
    simulator = make(2, "open_loop: true\ncmd_vel_timeout: 0.0", **LIFTED)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(2.0)
    assert simulator.bus.latest("/base/odom").pose.pose.position.x == pytest.approx(1.0, abs=0.006)


@pytest.mark.parametrize(
    ("distro", "more", "topic", "type"),
    [
        ("humble", "use_stamped_vel: false", "/base/cmd_vel_unstamped", TWIST),
        ("humble", "", "/base/cmd_vel", TWIST_STAMPED),
        ("jazzy", "use_stamped_vel: false", "/base/cmd_vel", TWIST_STAMPED),
        (None, "", "/base/cmd_vel", TWIST_STAMPED),
    ],
)
def test_topic_and_type_of_commands_by_distribution(
    make: Make, distro: str | None, more: str, topic: str, type: str
) -> None:
    simulator = make(2, more, ros_distro=distro, **LIFTED)
    assert simulator.command_topics == (topic,)
    message = twist((0.5, 0, 0), (0, 0, 0))
    if type == TWIST_STAMPED:
        message = from_fields(TWIST_STAMPED, {"twist": {"linear": {"x": 0.5}}})
    simulator.bus.publish(topic, type, message)
    simulator.run(0.2)
    assert wheels(simulator) == pytest.approx((5.0, 5.0))


def test_remapped(make: Make, write_rover: Callable[..., Path], tmp_path: Path) -> None:
    (tmp_path / "control.yaml").write_text(YAML_2)
    remapping = "<ros><remapping>/base/odom:=/odom</remapping><remapping>base/cmd_vel:=/cmd_vel</remapping></ros>"
    path = write_rover(ROS_2.replace("</parameters>", "</parameters>" + remapping))
    simulator = Simulator(path, **LIFTED)
    assert simulator.command_topics == ("/cmd_vel",)
    assert "/odom" in {topic.name for topic in simulator.bus.topics}


def test_the_radius_is_that_of_the_wheel_and_the_separation_that_of_the_joints(make: Make) -> None:
    simulator = make(1, **LIFTED)  # neither is written
    simulator.command((0.3, 0, 0), (0, 0, 1.0))
    simulator.run(0.2)
    assert wheels(simulator) == pytest.approx(((0.3 - 0.15) / 0.1, (0.3 + 0.15) / 0.1))


@pytest.mark.parametrize(
    ("ros", "old", "new", "message"),
    [
        (1, "    left_wheel: left_joint\n", "", "control.yaml:2:3: `base` has no `left_wheel`"),
        (1, "left_joint", "lef_joint", "control.yaml:4:17: no joint `lef_joint` in robot `rover`; did you mean"),
        (1, "[0.001, 0.002, 0, 0, 0, 0.03]", "[0.001]", "`pose_covariance_diagonal` has 1 numbers; it needs 6"),
        (2, "    wheel_radius: 0.1\n", "", "control.yaml:5:1: `base` has no `wheel_radius`"),
        (2, "wheel_radius: 0.1", "wheel_radius: -0.1", "`wheel_radius` is -0.1 m; it must be greater than zero"),
    ],
)
def test_wrong_parameters(make: Make, ros: int, old: str, new: str, message: str) -> None:
    yaml = YAML_1 if ros == 1 else YAML_2
    assert old in yaml
    with pytest.raises(UrdfkitError) as caught:
        make(ros, yaml=yaml.replace(old, new), strict=True)
    assert message in str(caught.value)


def heard(simulator: Any, topic: str, kind: str) -> list[Any]:
    found: list[Any] = []
    simulator.subscribe(topic, kind, found.append)
    return found


@pytest.mark.parametrize(("ros", "flag"), [(1, "publish_cmd: true"), (2, "publish_limited_velocity: true")])
def test_granted_velocities_are_published_when_asked(make: Make, ros: int, flag: str) -> None:
    limits = {1: "linear: {x: {has_acceleration_limits: true, max_acceleration: 1.0}}",
              2: "linear: {x: {max_acceleration: 1.0}}"}[ros]  # fmt: skip
    simulator = make(ros, f"{flag}\n{limits}")
    seen = heard(simulator, "/rover/base/cmd_vel_out" if ros == 1 else "/base/cmd_vel_out", TWIST_STAMPED)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(0.3)
    assert [message.twist.linear.x for message in seen][-1] == pytest.approx(0.3, abs=0.01)
    assert not make(ros).bus.has_subscribers("/base/cmd_vel_out")


def test_limits_of_slowing_down_and_of_going_backwards(make: Make) -> None:
    """Since Jazzy: up by 1, down by 2, and backwards up by 0.5 and down by 4 m/s²."""
    limits = (
        "linear: {x: {max_acceleration: 1.0, max_deceleration: -2.0, max_acceleration_reverse: -0.5, "
        "max_deceleration_reverse: 4.0}}\npublish_limited_velocity: true\ncmd_vel_timeout: 0.0"
    )
    simulator = make(2, limits)
    seen = heard(simulator, "/base/cmd_vel_out", TWIST_STAMPED)

    def slope(wanted: float, seconds: float) -> float:
        simulator.command((wanted, 0, 0), (0, 0, 0))
        simulator.run(0.1)
        first = len(seen)
        simulator.run(seconds)
        return float((seen[-1].twist.linear.x - seen[first].twist.linear.x) / ((len(seen) - 1 - first) / 200))

    assert slope(1.0, 0.2) == pytest.approx(1.0)
    simulator.run(2.0)
    assert slope(0.0, 0.2) == pytest.approx(-2.0)
    simulator.run(2.0)
    assert slope(-1.0, 0.2) == pytest.approx(-0.5)
    simulator.run(3.0)
    assert slope(0.0, 0.1) == pytest.approx(4.0)


@pytest.mark.parametrize(
    ("limits", "message"),
    [
        ("linear: {x: {max_deceleration: 2.0}}", "`linear.x.max_deceleration` is 2; it must not be positive"),
        (
            "angular: {z: {max_deceleration_reverse: -4.0}}",
            "`angular.z.max_deceleration_reverse` is -4; it must not be negative",
        ),
        (
            "linear: {x: {max_deceleration: -2.0, min_velocity: 0.1}}",
            "`linear.x.min_velocity` is 0.1; it must not be positive",
        ),
    ],
)
def test_limits_with_the_sign_that_ros_2_refuses_are_errors(make: Make, limits: str, message: str) -> None:
    with pytest.raises(UrdfkitError) as caught:
        make(2, limits, strict=True)
    assert message in str(caught.value)


def test_frames_of_ros_2_are_below_a_prefix_or_the_namespace(make: Make) -> None:
    for more, prefix in (
        ("", ""),
        ("tf_frame_prefix: front", "front/"),
        ("tf_frame_prefix: front\ntf_frame_prefix_enable: false", ""),
    ):
        simulator = make(2, more)
        simulator.run(0.1)
        message = simulator.bus.latest("/base/odom")
        assert (message.header.frame_id, message.child_frame_id) == (f"{prefix}odom", f"{prefix}base")
