"""Choice of controllers for the joints of a robot, and the model elements that they need."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import takewhile

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.scaffold.additions.joint_roles import Roles, WheelJoints
from urdfkit.scaffold.templates.names import sanitised, unused_name


@dataclass(frozen=True, slots=True)
class Flavour:
    """Names of ros2_control in one generation of Gazebo.

    Attributes:
        hardware: the plugin in ``<hardware>``.
        library: file name of Gazebo's plugin.
        name: name of Gazebo's plugin.
        package: the ROS package of both.
        mimic_parameters: whether ``<ros2_control>`` declares mimic joints; since Jazzy, ``<mimic>`` is sufficient.
    """

    hardware: str
    library: str
    name: str
    package: str
    mimic_parameters: bool = False


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
        mimic_parameters=True,
    ),
    "classic-ros2": Flavour(
        "gazebo_ros2_control/GazeboSystem",
        "libgazebo_ros2_control.so",
        "gazebo_ros2_control",
        "gazebo_ros2_control",
        mimic_parameters=True,
    ),
}
"""Names by generation; Gazebo Classic with ROS 1 uses transmissions instead."""


@dataclass(frozen=True, slots=True)
class ChosenController:
    """A controller to configure.

    Attributes:
        name: name of the controller.
        kind: ``trajectory`` or ``diff_drive``.
        joints: the joints that it moves; for a drive, the left ones before the right ones.
        wheels: the wheels of a drive.
        interface: command interface from existing transmissions or ``<ros2_control>``; empty for joints that get one
            together with the controller.
    """

    name: str
    kind: str
    joints: tuple[str, ...]
    wheels: WheelJoints | None = None
    interface: str = ""


def controllers(roles: Roles) -> list[ChosenController]:
    """Return the controllers for the joints that need one.

    Args:
        roles: the purpose of each joint.
    """
    made = []
    if roles.wheels is not None:
        joints = roles.wheels.left + roles.wheels.right
        by = roles.interfaces.get(joints[0], "")
        made.append(ChosenController("base_controller", "diff_drive", joints, roles.wheels, by))
    taken = {"gripper_controller", "base_controller"}
    for chain in roles.arms:
        for interface, joints in _by_interface(chain, roles):
            name = unused_name(_name(joints), lambda each: f"{each}_controller" in taken)
            taken.add(f"{name}_controller")
            made.append(ChosenController(f"{name}_controller", "trajectory", joints, None, interface))
    for interface, joints in _by_interface(roles.fingers, roles):
        name = (
            f"gripper_{interface}_controller"
            if made and made[-1].name == "gripper_controller"
            else "gripper_controller"
        )
        made.append(ChosenController(name, "trajectory", joints, None, interface))
    return made


def _by_interface(joints: Sequence[str], roles: Roles) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Yield the joints grouped by command interface: all joints of a controller have the same one."""
    for interface in dict.fromkeys(roles.interfaces.get(joint, "") for joint in joints):
        yield interface, tuple(joint for joint in joints if roles.interfaces.get(joint, "") == interface)


def _name(joints: tuple[str, ...]) -> str:
    """Return the common prefix of joint names without a trailing underscore; ``arm`` without one."""
    words = [joint.removesuffix("_joint").split("_") for joint in joints]
    common = [each[0] for each in takewhile(lambda each: len(set(each)) == 1, zip(*words, strict=False))]
    name = sanitised("_".join(common)) if common else "arm"
    return "arm" if name in ("joint", "link", "robot") else name


def markup(
    robot: Robot, made: list[ChosenController], *, name: str, generation: str, package: str, looped: bool
) -> str:
    """Return the elements to add to the model, indented by two blanks per level.

    Args:
        robot: the robot that is controlled.
        made: the controllers.
        name: name of the robot, which is the namespace of its controllers.
        generation: a key of `FLAVOURS`, or ``classic``.
        package: package with the controllers' parameters.
        looped: whether the model already has the Gazebo plugin that runs controllers.

    Returns:
        An empty text if the model needs no further element.
    """
    new = [each for each in made if not each.interface]
    if generation == "classic":
        lines = [*_transmissions(new), *(() if looped else _loop1(name))]
    else:
        flavour = FLAVOURS[generation]
        lines = [*(_ros2(robot, new, name, flavour) if new else ()), *(() if looped else _loop2(flavour, package))]
    return "\n".join(lines)


def needs(made: list[ChosenController], generation: str) -> tuple[str, ...]:
    """Return the packages that provide the controllers, and the Gazebo plugin that runs them.

    Args:
        made: the controllers.
        generation: a key of `FLAVOURS`, or ``classic``.
    """
    packages = []
    for each in made:
        packages.append("diff_drive_controller" if each.kind == "diff_drive" else "joint_trajectory_controller")
        if generation == "classic" and each.kind == "trajectory":
            packages.append(f"{each.interface or 'velocity'}_controllers")
    packages.append("gazebo_ros_control" if generation == "classic" else FLAVOURS[generation].package)
    return tuple(dict.fromkeys(packages))


def _transmissions(made: list[ChosenController]) -> Iterator[str]:
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


def _ros2(robot: Robot, made: list[ChosenController], name: str, flavour: Flavour) -> Iterator[str]:
    name = unused_name(name, lambda each: any(control.name == each for control in robot.ros2_control))
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
            yield from (line for follower in _followers(robot, joint) for line in _mimic_joint(follower, flavour))
    yield "</ros2_control>"


def _followers(robot: Robot, name: str) -> Iterator[Joint]:
    """Yield the joints that mimic another and are not in ``<ros2_control>``, where they have to be."""
    listed = {each.get("name") for control in robot.ros2_control for each in control.element.find_all("joint")}
    for joint in robot.joints:
        if joint.mimic is not None and joint.mimic.joint == name and joint.name not in listed:
            yield joint


def _mimic_joint(joint: Joint, flavour: Flavour) -> Iterator[str]:
    yield f'  <joint name="{joint.name}">'
    if flavour.mimic_parameters and joint.mimic is not None:
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
    """Return the initial position of a joint: zero, or the middle of limits that exclude zero."""
    low, high = (joint.limit.lower, joint.limit.upper) if joint.limit is not None else (None, None)
    if joint.type == "continuous" or low is None or high is None or low <= 0 <= high:
        return 0.0
    return (low + high) / 2
