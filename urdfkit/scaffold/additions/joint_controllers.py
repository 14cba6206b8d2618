"""Controllers for the joints of a robot: which, and the elements of the model that they need."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.scaffold.additions.joint_roles import Roles, Wheels
from urdfkit.scaffold.templates.names import free, sanitised


@dataclass(frozen=True, slots=True)
class Flavour:
    """What ros2_control is called in a simulator.

    Attributes:
        hardware: the plugin of ``<hardware>``.
        library: the file of Gazebo's plugin.
        name: what Gazebo's plugin is called.
        package: where they are.
        told_of_mimics: whether ``<ros2_control>`` has to say which joints follow others; since jazzy ``<mimic>`` does.
    """

    hardware: str
    library: str
    name: str
    package: str
    told_of_mimics: bool = False


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
        told_of_mimics=True,
    ),
    "classic-ros2": Flavour(
        "gazebo_ros2_control/GazeboSystem",
        "libgazebo_ros2_control.so",
        "gazebo_ros2_control",
        "gazebo_ros2_control",
        told_of_mimics=True,
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
        interface: what its joints can be told, by transmissions or in ``<ros2_control>`` that are there; empty for
            joints that get theirs with it.
    """

    name: str
    kind: str
    joints: tuple[str, ...]
    wheels: Wheels | None = None
    interface: str = ""


def controllers(found: Roles) -> list[Controller]:
    """Return the controllers for the joints that something should move.

    Args:
        found: what they are for.
    """
    made = []
    if found.wheels is not None:
        joints = found.wheels.left + found.wheels.right
        by = found.interfaces.get(joints[0], "")
        made.append(Controller("base_controller", "diff_drive", joints, found.wheels, by))
    taken = {"gripper_controller", "base_controller"}
    for chain in found.arms:
        for interface, joints in _by_interface(chain, found):
            name = free(_name(joints), lambda each: f"{each}_controller" in taken)
            taken.add(f"{name}_controller")
            made.append(Controller(f"{name}_controller", "trajectory", joints, None, interface))
    for interface, joints in _by_interface(found.fingers, found):
        name = (
            f"gripper_{interface}_controller"
            if made and made[-1].name == "gripper_controller"
            else "gripper_controller"
        )
        made.append(Controller(name, "trajectory", joints, None, interface))
    return made


def _by_interface(joints: Sequence[str], found: Roles) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the joints by what they can be told: a controller tells all of its joints the same."""
    for interface in dict.fromkeys(found.interfaces.get(joint, "") for joint in joints):
        yield interface, tuple(joint for joint in joints if found.interfaces.get(joint, "") == interface)


def _name(joints: tuple[str, ...]) -> str:
    """Return what the joints of a chain have in common at the beginning of their names; ``arm`` for nothing."""
    words = [joint.removesuffix("_joint").split("_") for joint in joints]
    common = [each[0] for each in takewhile(lambda each: len(set(each)) == 1, zip(*words, strict=False))]
    name = sanitised("_".join(common)) if common else "arm"
    return "arm" if name in ("joint", "link", "robot") else name


def markup(robot: Robot, made: list[Controller], *, name: str, generation: str, package: str, looped: bool) -> str:
    """Return the elements of the model: which joints are moved, and how; indented by two blanks a level.

    Args:
        robot: whose joints.
        made: the controllers.
        name: of the robot, where its controllers are.
        generation: of `FLAVOURS`, or ``classic``.
        package: with the controllers' parameters.
        looped: whether the model has the plugin of Gazebo that runs controllers.

    Returns:
        Nothing where the model has it all.
    """
    new = [each for each in made if not each.interface]
    if generation == "classic":
        lines = [*_transmissions(new), *(() if looped else _loop1(name))]
    else:
        flavour = FLAVOURS[generation]
        lines = [*(_ros2(robot, new, name, flavour) if new else ()), *(() if looped else _loop2(flavour, package))]
    return "\n".join(lines)


def needs(made: list[Controller], generation: str) -> tuple[str, ...]:
    """Return the packages that the controllers are in, and what lets Gazebo run them.

    Args:
        made: the controllers.
        generation: of `FLAVOURS`, or ``classic``.
    """
    packages = []
    for each in made:
        packages.append("diff_drive_controller" if each.kind == "diff_drive" else "joint_trajectory_controller")
        if generation == "classic" and each.kind == "trajectory":
            packages.append(f"{each.interface or 'velocity'}_controllers")
    packages.append("gazebo_ros_control" if generation == "classic" else FLAVOURS[generation].package)
    return tuple(dict.fromkeys(packages))


def _transmissions(made: list[Controller]) -> Iterator[str]:
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


def _loop1(name: str) -> Iterator[str]:
    yield "<gazebo>"
    yield '  <plugin name="gazebo_ros_control" filename="libgazebo_ros_control.so">'
    yield f"    <robotNamespace>/{name}</robotNamespace>"
    yield "  </plugin>"
    yield "</gazebo>"


def _ros2(robot: Robot, made: list[Controller], name: str, flavour: Flavour) -> Iterator[str]:
    name = free(name, lambda each: any(control.name == each for control in robot.ros2_control))
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
            yield from (line for follower in _followers(robot, joint) for line in _follows(follower, flavour))
    yield "</ros2_control>"


def _followers(robot: Robot, name: str) -> Iterator[Joint]:
    """Yield the joints that follow another and stand in no ``<ros2_control>``: those of it alone do follow."""
    listed = {each.get("name") for control in robot.ros2_control for each in control.element.find_all("joint")}
    for joint in robot.joints:
        if joint.mimic is not None and joint.mimic.joint == name and joint.name not in listed:
            yield joint


def _follows(joint: Joint, flavour: Flavour) -> Iterator[str]:
    yield f'  <joint name="{joint.name}">'
    if flavour.told_of_mimics and joint.mimic is not None:
        yield f'    <param name="mimic">{joint.mimic.joint}</param>'
        yield f'    <param name="multiplier">{joint.mimic.multiplier:g}</param>'
    yield '    <state_interface name="position"/>'
    yield '    <state_interface name="velocity"/>'
    yield "  </joint>"


def _loop2(flavour: Flavour, package: str) -> Iterator[str]:
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
