"""Controllers for the joints of a robot: the elements of the model, and the parameters."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import count, takewhile

from urdfkit.description.robot import Joint, Robot
from urdfkit.scaffold.joint_roles import Roles, Wheels
from urdfkit.scaffold.names import sanitised


@dataclass(frozen=True, slots=True)
class Flavour:
    """What ros2_control is called in a simulator.

    Attributes:
        hardware: the plugin of ``<hardware>``.
        library: the file of Gazebo's plugin.
        name: what Gazebo's plugin is called.
        package: where they are.
    """

    hardware: str
    library: str
    name: str
    package: str


FLAVOURS = {
    "gz": Flavour(
        "gz_ros2_control/GazeboSimSystem",
        "gz_ros2_control-system",
        "gz_ros2_control::GazeboSimROS2ControlPlugin",
        "gz_ros2_control",
    ),
    "fortress": Flavour(
        "ign_ros2_control/IgnitionSystem",
        "ign_ros2_control-system",
        "ign_ros2_control::IgnitionROS2ControlPlugin",
        "ign_ros2_control",
    ),
    "classic-ros2": Flavour(
        "gazebo_ros2_control/GazeboSystem",
        "libgazebo_ros2_control.so",
        "gazebo_ros2_control",
        "gazebo_ros2_control",
    ),
}
"""By generation; Gazebo Classic with ROS 1 has transmissions instead."""


@dataclass(frozen=True, slots=True)
class Controller:
    """One controller.

    Attributes:
        name: of it.
        kind: ``trajectory`` or ``diff_drive``.
        joints: that it moves; of a drive, the left ones and then the right ones.
        wheels: of a drive.
    """

    name: str
    kind: str
    joints: tuple[str, ...]
    wheels: Wheels | None = None


def controllers(found: Roles) -> list[Controller]:
    """Return the controllers for the joints that something should move.

    Args:
        found: what they are for.
    """
    made = []
    if found.wheels is not None:
        made.append(Controller("base_controller", "diff_drive", found.wheels.left + found.wheels.right, found.wheels))
    taken = {"gripper_controller", "base_controller"}
    for joints in found.arms:
        name = _name(joints)
        number = next(n for n in count(1) if (name if n == 1 else f"{name}_{n}") + "_controller" not in taken)
        taken.add(full := (name if number == 1 else f"{name}_{number}") + "_controller")
        made.append(Controller(full, "trajectory", joints))
    if found.fingers:
        made.append(Controller("gripper_controller", "trajectory", found.fingers))
    return made


def _name(joints: tuple[str, ...]) -> str:
    """Return what the joints of a chain have in common at the beginning of their names; ``arm`` for nothing."""
    words = [joint.removesuffix("_joint").split("_") for joint in joints]
    common = [each[0] for each in takewhile(lambda each: len(set(each)) == 1, zip(*words, strict=False))]
    name = sanitised("_".join(common)) if common else "arm"
    return "arm" if name in ("joint", "link", "robot") else name


def markup(robot: Robot, made: list[Controller], *, name: str, generation: str, package: str) -> str:
    """Return the elements of the model: which joints are moved, and how; indented by two blanks a level.

    Args:
        robot: whose joints.
        made: the controllers.
        name: of the robot, where its controllers are.
        generation: of `FLAVOURS`, or ``classic``.
        package: with the controllers' parameters.
    """
    lines = _ros1(made, name) if generation == "classic" else _ros2(robot, made, name, FLAVOURS[generation], package)
    return "\n".join(lines)


def parameters(made: list[Controller], *, generation: str, base: str) -> dict[str, str]:
    """Return what the template of a package of controllers wants: ``controllers``, ``managed`` and ``spawned``.

    Args:
        made: the controllers.
        generation: of `FLAVOURS`, or ``classic``.
        base: the frame that odometry is of.
    """
    if generation == "classic":
        text = "".join(
            f"\n\n  {each.name}:\n" + "\n".join(f"    {line}" for line in _yaml1(each, base)) for each in made
        )
        spawned = "".join(f" {each.name}" for each in made)
        return {"controllers": text, "managed": "", "spawned": spawned}
    types = {
        "trajectory": "joint_trajectory_controller/JointTrajectoryController",
        "diff_drive": "diff_drive_controller/DiffDriveController",
    }
    text = "".join(
        f"\n{each.name}:\n  ros__parameters:\n" + "".join(f"    {line}\n" for line in _yaml2(each, base))
        for each in made
    )
    managed = "".join(f"\n    {each.name}: {{type: {types[each.kind]}}}" for each in made)
    spawned = "".join(f' "{each.name}",' for each in made).removesuffix(",")
    return {"controllers": text.rstrip("\n"), "managed": managed, "spawned": spawned}


def needs(made: list[Controller], generation: str) -> tuple[str, ...]:
    """Return the packages that the controllers are in, and what lets Gazebo run them.

    Args:
        made: the controllers.
        generation: of `FLAVOURS`, or ``classic``.
    """
    velocity = ["velocity_controllers"] if generation == "classic" else []
    by_kind = {"trajectory": ["joint_trajectory_controller", *velocity], "diff_drive": ["diff_drive_controller"]}
    hardware = "gazebo_ros_control" if generation == "classic" else FLAVOURS[generation].package
    return tuple(dict.fromkeys([*(name for each in made for name in by_kind[each.kind]), hardware]))


def _ros1(made: list[Controller], name: str) -> Iterator[str]:
    for joint in (joint for each in made for joint in each.joints):
        yield f'<transmission name="{joint}_transmission">'
        yield "  <type>transmission_interface/SimpleTransmission</type>"
        yield f'  <joint name="{joint}">'
        yield "    <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface>"
        yield "  </joint>"
        yield f'  <actuator name="{joint}_motor">'
        yield "    <mechanicalReduction>1</mechanicalReduction>"
        yield "  </actuator>"
        yield "</transmission>"
    yield "<gazebo>"
    yield '  <plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so">'
    yield f"    <robotNamespace>/{name}</robotNamespace>"
    yield "  </plugin>"
    yield "</gazebo>"


def _ros2(robot: Robot, made: list[Controller], name: str, flavour: Flavour, package: str) -> Iterator[str]:
    yield f'<ros2_control name="{name}" type="system">'
    yield "  <hardware>"
    yield f"    <plugin>{flavour.hardware}</plugin>"
    yield "  </hardware>"
    for each in made:
        command = "velocity" if each.kind == "diff_drive" else "position"
        for joint in each.joints:
            yield f'  <joint name="{joint}">'
            yield f'    <command_interface name="{command}"/>'
            start = _start(robot.joint_by_name[joint])
            if command == "position" and start:
                yield '    <state_interface name="position">'
                yield f'      <param name="initial_value">{start:.6g}</param>'
                yield "    </state_interface>"
            else:
                yield '    <state_interface name="position"/>'
            yield '    <state_interface name="velocity"/>'
            yield "  </joint>"
    yield "</ros2_control>"
    yield "<gazebo>"
    yield f'  <plugin filename="{flavour.library}" name="{flavour.name}">'
    yield f"    <parameters>$(find {package})/config/controllers.yaml</parameters>"
    yield "  </plugin>"
    yield "</gazebo>"


def _start(joint: Joint) -> float:
    """Return where a joint begins: at zero, or in the middle of limits that do not have it."""
    low, high = (joint.limit.lower, joint.limit.upper) if joint.limit is not None else (None, None)
    if joint.type == "continuous" or low is None or high is None or low <= 0 <= high:
        return 0.0
    return (low + high) / 2


def _yaml1(each: Controller, base: str) -> Iterator[str]:
    if each.wheels is not None:
        yield "type: diff_drive_controller/DiffDriveController"
        yield f"left_wheel: [{', '.join(each.wheels.left)}]"
        yield f"right_wheel: [{', '.join(each.wheels.right)}]"
        yield f"wheel_separation: {each.wheels.separation:.6g}"
        yield f"wheel_radius: {each.wheels.radius:.6g}"
        yield f"base_frame_id: {base}"
        yield "publish_rate: 50"
        yield "pose_covariance_diagonal: [0.001, 0.001, 1000000.0, 1000000.0, 1000000.0, 0.03]"
        yield "twist_covariance_diagonal: [0.001, 0.001, 1000000.0, 1000000.0, 1000000.0, 0.03]"
        return
    yield "type: velocity_controllers/JointTrajectoryController"
    yield f"joints: [{', '.join(each.joints)}]"
    yield "gains:"
    yield from (f"  {joint}: {{p: 20.0, i: 0.0, d: 0.0}}" for joint in each.joints)
    yield "velocity_ff:"
    yield from (f"  {joint}: 1.0" for joint in each.joints)
    yield "allow_partial_joints_goal: true"
    yield "constraints:"
    yield "  stopped_velocity_tolerance: 0.05"
    yield "  goal_time: 1.0"


def _yaml2(each: Controller, base: str) -> Iterator[str]:
    if each.wheels is not None:
        yield f"left_wheel_names: [{', '.join(each.wheels.left)}]"
        yield f"right_wheel_names: [{', '.join(each.wheels.right)}]"
        yield f"wheel_separation: {each.wheels.separation:.6g}"
        yield f"wheel_radius: {each.wheels.radius:.6g}"
        yield f"base_frame_id: {base}"
        yield "publish_rate: 50.0"
        return
    yield f"joints: [{', '.join(each.joints)}]"
    yield "command_interfaces: [position]"
    yield "state_interfaces: [position, velocity]"
    yield "allow_partial_joints_goal: true"
    yield "constraints:"
    yield "  stopped_velocity_tolerance: 0.05"
    yield "  goal_time: 1.0"
