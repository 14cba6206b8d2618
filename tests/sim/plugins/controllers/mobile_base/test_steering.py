"""Steering and mecanum controllers: laws, odometry next to where the robot really is, timeouts, topics, errors."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.errors import UrdfkitError
from urdfkit.messages import TWIST_STAMPED, from_fields
from urdfkit.sim import Simulator, Spawn

RADIUS, TRACK, BASE = 0.1, 0.4, 0.6

LINK = """
  <link name="{name}">{collision}
    <inertial><mass value="0.5"/><inertia ixx="0.002" ixy="0" ixz="0" iyy="0.002" iyz="0" izz="0.002"/></inertial>
  </link>
  <joint name="{name}_joint" type="{type}">
    <parent link="{parent}"/><child link="{name}"/><origin xyz="{x} {y} {z}"/><axis xyz="{axis}"/>
    <limit lower="-0.8" upper="0.8" effort="50" velocity="40"/>
  </joint>
"""
SPHERE = f'<collision><geometry><sphere radius="{RADIUS}"/></geometry></collision>'
BODY = """<robot name="car"><link name="base">
  <inertial><origin xyz="{x} 0 0.12"/><mass value="10"/>
    <inertia ixx="0.2" ixy="0" ixz="0" iyy="0.5" iyz="0" izz="0.6"/></inertial></link>
"""
Make = Callable[..., Any]


def wheel(name: str, x: float, y: float, parent: str = "base", z: float = RADIUS) -> str:
    return LINK.format(name=name, type="continuous", parent=parent, x=x, y=y, z=z, axis="0 1 0", collision=SPHERE)


def knuckle(name: str, y: float) -> str:
    return LINK.format(name=name, type="revolute", parent="base", x=BASE, y=y, z=RADIUS, axis="0 0 1", collision="")


def car(kind: str) -> str:
    """Return a car with two driven wheels behind, and one or two steered wheels ahead; a bicycle has ball-like feet."""
    text = BODY.format(x=0.3)
    if kind == "bicycle":
        text += wheel("rear", 0, 0) + knuckle("steer", 0) + wheel("front", 0, 0, "steer", 0)
        for side, y in (("left", 0.3), ("right", -0.3)):
            text += (
                f'<link name="{side}_foot">{SPHERE}</link><joint name="{side}_foot_joint" type="fixed">'
                f'<parent link="base"/><child link="{side}_foot"/><origin xyz="0.3 {y} {RADIUS}"/></joint>'
                f'<gazebo reference="{side}_foot"><mu1>0</mu1><mu2>0</mu2></gazebo>'
            )
        return text
    text += wheel("rear_right", 0, -TRACK / 2) + wheel("rear_left", 0, TRACK / 2)
    if kind == "tricycle":
        return text + knuckle("steer", 0) + wheel("front", 0, 0, "steer", 0)
    for side, y in (("right", -TRACK / 2), ("left", TRACK / 2)):
        text += knuckle(f"{side}_steer", y) + wheel(f"front_{side}", 0, 0, f"{side}_steer", 0)
    return text


def platform() -> str:
    places = {"front": 0.15, "rear": -0.15, "left": 0.25, "right": -0.25}
    corners = [corner.split("_") for corner in CORNERS]
    return BODY.format(x=0.0) + "".join(wheel(f"{end}_{side}", places[end], places[side]) for end, side in corners)


NAMES = {
    "bicycle": (["rear_joint"], ["steer_joint"]),
    "tricycle": (["rear_right_joint", "rear_left_joint"], ["steer_joint"]),
    "ackermann": (["rear_right_joint", "rear_left_joint"], ["right_steer_joint", "left_steer_joint"]),
}


@pytest.fixture
def make(tmp_path: Path) -> Make:
    def build(body: str, type: str, parameters: str, driven: list[str], steered: list[str] = [],  # noqa: B006
              *, ros: int = 2, **options: Any) -> Any:  # fmt: skip
        indented = "".join(f"    {line}\n" for line in parameters.splitlines())
        control = tmp_path / "control.yaml"
        if ros == 2:
            joints = "".join(
                f'<joint name="{name}"><command_interface name="{kind}"/></joint>'
                for kind, names in (("velocity", driven), ("position", steered))
                for name in names
            )
            body += (
                '<ros2_control name="r" type="system"><hardware><plugin>gazebo_ros2_control/GazeboSystem</plugin>'
                f'</hardware>{joints}</ros2_control><gazebo><plugin filename="libgazebo_ros2_control.so" name="c">'
                "<parameters>control.yaml</parameters></plugin></gazebo>"
            )
            control.write_text(
                f"controller_manager:\n  ros__parameters:\n    update_rate: 100\n    base: {{type: {type}}}\n"
                f"base:\n  ros__parameters:\n{indented}"
            )
        else:
            for kind, names in (("Velocity", driven), ("Position", steered)):
                for name in names:
                    body += (
                        f'<transmission name="t_{name}"><type>transmission_interface/SimpleTransmission</type>'
                        f'<joint name="{name}"><hardwareInterface>hardware_interface/{kind}JointInterface'
                        "</hardwareInterface></joint></transmission>"
                    )
            body += '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>'
            control.write_text(f"car:\n  base:\n    type: {type}\n{indented}")
            options["controllers"] = [control]
        path = tmp_path / "car.urdf"
        path.write_text(body + "</robot>")
        options.setdefault("note", lambda _: None)
        return Simulator(path, **options)

    return build


@pytest.fixture
def steered(make: Make) -> Make:
    def build(kind: str, more: str = "", **options: Any) -> Any:
        driven, turned = NAMES[kind]
        measures = f"wheelbase: {BASE}\n"
        if kind == "bicycle":
            measures += f"traction_wheel_radius: {RADIUS}\n"
        else:
            measures += f"traction_wheels_radius: {RADIUS}\ntraction_track_width: {TRACK}\n"
        names = f"traction_joints_names: {driven}\nsteering_joints_names: {turned}\n".replace("'", "")
        type = f"{kind}_steering_controller/{kind.capitalize()}SteeringController"
        return make(car(kind), type, names + measures + more, driven, turned, **options)

    return build


def at(simulator: Any) -> tuple[float, float, float]:
    x, y, _, _, _, qz, qw = simulator.state.base_pose
    return x, y, 2 * math.atan2(qz, qw)


def reckoned(simulator: Any) -> tuple[float, float, float]:
    pose = simulator.bus.latest("/base/odometry").pose.pose
    ((told, turn),) = simulator.odometry().values()  # of now; published has been a little earlier
    assert told == pytest.approx((pose.position.x, pose.position.y, 0.0), abs=0.02)
    assert abs(turn[2] * pose.orientation.w - turn[3] * pose.orientation.z) < 0.02
    return pose.position.x, pose.position.y, 2 * math.atan2(pose.orientation.z, pose.orientation.w)


def drive(simulator: Any, v: float, w: float, seconds: float, *, left: float = 0.0) -> None:
    """Send a command ten times a second."""
    for _ in range(round(seconds * 10)):
        simulator.command((v, left, 0), (0, 0, w))
        simulator.run(0.1)


@pytest.mark.parametrize("kind", list(NAMES))
@pytest.mark.parametrize(("v", "w"), [(0.5, 0.0), (0.5, 0.4), (0.4, -0.3), (-0.4, 0.2)])
def test_it_turns_at_the_yaw_rate_it_is_told(steered: Make, kind: str, v: float, w: float) -> None:
    simulator = steered(kind)
    for part in range(1, 11):  # gently, so that no wheel spins
        drive(simulator, v * part / 10, w * part / 10, 0.1)
    drive(simulator, v, w, 1.0)
    before = at(simulator)[2]
    drive(simulator, v, w, 3.0)
    assert math.remainder(at(simulator)[2] - before, 2 * math.pi) == pytest.approx(3.0 * w, abs=0.03)
    speed = simulator.state.base_velocity
    assert math.hypot(*speed[:2]) == pytest.approx(abs(v), rel=0.01)
    x, y, heading = at(simulator)
    believed = reckoned(simulator)
    assert math.hypot(believed[0] - x, believed[1] - y) < 0.03
    assert abs(math.remainder(believed[2] - heading, 2 * math.pi)) < 0.03
    measured = simulator.bus.latest("/base/odometry").twist.twist
    assert (measured.linear.x, measured.angular.z) == pytest.approx((v, w), abs=0.01)


def test_wheels_of_an_ackermann_point_at_one_centre(steered: Make) -> None:
    simulator = steered("ackermann", fixed_base=True, spawn=Spawn(z=1.0))
    drive(simulator, 0.5, 0.5, 2.0)
    right, left = (simulator.state.position(f"{side}_steer_joint") for side in ("right", "left"))
    assert BASE / math.tan(right) - BASE / math.tan(left) == pytest.approx(TRACK, rel=1e-6)
    assert 0.5 * (BASE / math.tan(right) + BASE / math.tan(left)) == pytest.approx(0.5 / 0.5, rel=1e-6)
    rates = [simulator.state.velocity(f"rear_{side}_joint") * RADIUS for side in ("right", "left")]
    assert rates == pytest.approx([0.5 * (1 + TRACK / 2), 0.5 * (1 - TRACK / 2)], rel=1e-6)


def test_wheels_stop_and_the_steering_stays_when_references_cease(steered: Make) -> None:
    simulator = steered("tricycle", "reference_timeout: 0.3\n")
    drive(simulator, 0.5, 0.4, 1.0)
    angle = simulator.state.position("steer_joint")
    simulator.run(1.0)
    assert simulator.state.velocity("rear_left_joint") == pytest.approx(0.0, abs=1e-6)
    assert simulator.state.position("steer_joint") == pytest.approx(angle, abs=1e-3)
    assert simulator.command_topics == ("/base/reference",)


def test_a_reference_with_an_old_stamp_does_not_count(steered: Make) -> None:
    simulator = steered("tricycle")
    simulator.run(2.0)
    fields = {"header": {"stamp": {"sec": 0, "nanosec": 500_000_000}}, "twist": {"linear": {"x": 1.0}}}
    simulator.bus.publish("/base/reference", TWIST_STAMPED, from_fields(TWIST_STAMPED, fields))
    simulator.run(0.5)
    assert simulator.state.base_velocity[0] == pytest.approx(0.0, abs=1e-6)


def test_topics_of_steering_controllers(steered: Make) -> None:
    names = {topic.name: topic.type for topic in steered("bicycle").bus.topics}
    assert names["/base/odometry"] == "nav_msgs/msg/Odometry"
    assert names["/base/tf_odometry"] == "tf2_msgs/msg/TFMessage"
    plain = steered("bicycle", "use_stamped_vel: false\n")
    assert plain.command_topics == ("/base/reference_unstamped",)


def test_names_of_humble(make: Make) -> None:
    driven, turned = NAMES["ackermann"]
    parameters = (
        f"front_steering: true\nrear_wheels_names: {driven}\nfront_wheels_names: {turned}\nwheelbase: {BASE}\n"
        f"rear_wheel_track: {TRACK}\nfront_wheel_track: {TRACK}\nrear_wheels_radius: {RADIUS}\n"
        f"front_wheels_radius: {RADIUS}\n"
    ).replace("'", "")
    simulator = make(
        car("ackermann"), "ackermann_steering_controller/AckermannSteeringController", parameters, driven, turned
    )
    drive(simulator, 0.5, 0.3, 2.0)
    assert simulator.state.base_velocity[5] == pytest.approx(0.3, abs=0.01)


def test_that_of_ros_1_takes_the_angle_on_cmd_vel(make: Make) -> None:
    parameters = (
        f"rear_wheel: rear_joint\nfront_steer: steer_joint\nwheel_separation_h: {BASE}\nwheel_radius: {RADIUS}\n"
        "pose_covariance_diagonal: [0, 0, 0, 0, 0, 0]\ntwist_covariance_diagonal: [0, 0, 0, 0, 0, 0]\n"
    )
    simulator = make(
        car("bicycle"), "ackermann_steering_controller/AckermannSteeringController", parameters,
        ["rear_joint"], ["steer_joint"], ros=1,
    )  # fmt: skip
    assert simulator.command_topics == ("/car/base/cmd_vel",)
    for part in range(1, 11):
        drive(simulator, 0.05 * part, 0.3, 0.1)
    drive(simulator, 0.5, 0.3, 2.0)
    assert simulator.state.position("steer_joint") == pytest.approx(0.3, abs=1e-3)
    assert simulator.state.base_velocity[5] == pytest.approx(0.5 * math.tan(0.3) / BASE, rel=0.02)
    pose = simulator.bus.latest("/car/base/odom").pose.pose.position
    assert (pose.x, pose.y) == pytest.approx(at(simulator)[:2], abs=0.02)
    simulator.run(1.5)  # commands cease: it brakes and steers straight on
    assert simulator.state.position("steer_joint") == pytest.approx(0.0, abs=1e-3)
    assert simulator.state.base_velocity[0] == pytest.approx(0.0, abs=1e-6)


CORNERS = ("front_left", "front_right", "rear_left", "rear_right")
MECANUM = (
    "".join(f"{corner}_wheel_command_joint_name: {corner}_joint\n" for corner in CORNERS)
    + "kinematics: {wheels_radius: 0.1, sum_of_robot_center_projection_on_X_Y_axis: 0.4, base_frame_offset: {x: 0.2, "
    "y: -0.1, theta: 0.5}}\nreference_timeout: 0.5\n"
)


def mecanum(make: Make, parameters: str = MECANUM, **options: Any) -> Any:
    joints = [f"{corner}_joint" for corner in CORNERS]
    return make(platform(), "mecanum_drive_controller/MecanumDriveController", parameters, joints, **options)


def test_mecanum_wheels_and_odometry(make: Make) -> None:
    simulator = mecanum(make, fixed_base=True, spawn=Spawn(z=1.0))
    drive(simulator, 0.3, 0.5, 4.0, left=-0.2)
    message = simulator.bus.latest("/base/odometry")
    twist = message.twist.twist
    assert (twist.linear.x, twist.linear.y, twist.angular.z) == pytest.approx((0.3, -0.2, 0.5), abs=1e-6)
    # A body that moves so in its own axes goes round a circle.
    turn = 0.5 * 4.0
    x = (0.3 * math.sin(turn) - 0.2 * (math.cos(turn) - 1)) / 0.5
    y = (0.3 * (1 - math.cos(turn)) + -0.2 * math.sin(turn)) / 0.5
    assert reckoned(simulator) == pytest.approx((x, y, turn), abs=0.02)
    offset_x, offset_y, theta = 0.2, -0.1, 0.5
    ahead = 0.3 * math.cos(theta) + 0.2 * math.sin(theta) + offset_y * 0.5
    left = 0.3 * math.sin(theta) - 0.2 * math.cos(theta) - offset_x * 0.5
    assert simulator.state.velocity("front_left_joint") == pytest.approx((ahead - left - 0.4 * 0.5) / 0.1, rel=1e-6)
    assert simulator.state.velocity("rear_right_joint") == pytest.approx((ahead - left + 0.4 * 0.5) / 0.1, rel=1e-6)
    simulator.run(1.0)
    assert simulator.state.velocity("front_left_joint") == pytest.approx(0.0, abs=1e-6)


def test_a_timeout_of_zero_is_noted(make: Make) -> None:
    notes: list[str] = []
    simulator = mecanum(make, MECANUM.replace("reference_timeout: 0.5\n", ""), note=notes.append)
    assert any("`reference_timeout` is 0: a reference is valid for one control period" in note for note in notes)
    simulator.command((0.5, 0, 0), (0, 0, 0))
    simulator.run(1.0)
    assert simulator.state.base_velocity[0] == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(
    ("kind", "old", "new", "message"),
    [
        ("ackermann", "rear_right_joint, ", "", "names 1 joints; `AckermannSteeringController` has 2, the right one"),
        ("tricycle", f"wheelbase: {BASE}", "wheelbase: 0", "`wheelbase` is 0 m; it must be greater than zero"),
        ("tricycle", f"wheelbase: {BASE}", "", "`base` has no `wheelbase`"),
        ("bicycle", "steering_joints_names: [steer_joint]", "steering_joints_names: [ster_joint]", "did you mean"),
    ],
)
def test_wrong_parameters_are_refused_at_their_place(make: Make, kind: str, old: str, new: str, message: str) -> None:
    driven, turned = NAMES[kind]
    measures = f"wheelbase: {BASE}\ntraction_wheels_radius: {RADIUS}\ntraction_track_width: {TRACK}\n"
    parameters = f"traction_joints_names: {driven}\nsteering_joints_names: {turned}\n".replace("'", "") + measures
    assert old in parameters
    type = f"{kind}_steering_controller/{kind.capitalize()}SteeringController"
    with pytest.raises(UrdfkitError) as caught:
        make(car(kind), type, parameters.replace(old, new), driven, turned, strict=True)
    assert "control.yaml:" in str(caught.value)
    assert message in str(caught.value)
