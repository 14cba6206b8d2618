"""Hardware interfaces of ros_control and ros2_control, and misspelt names of them in transmissions."""

from collections.abc import Iterator

from urdfkit.description.urdf.robot import Robot, Transmission
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.fix_builders import meant, nearest

PACKAGE = "hardware_interface"
"""Package prefix of the interface names, before the slash."""

INTERFACES = (
    *("EffortJointInterface", "VelocityJointInterface", "PositionJointInterface", "PosVelJointInterface"),
    *("PosVelAccJointInterface", "JointStateInterface", "JointCommandInterface", "ActuatorStateInterface"),
    *("ForceTorqueSensorInterface", "ImuSensorInterface", "JointModeInterface"),
)
"""Interfaces of the package hardware_interface in ROS Noetic."""

STANDARD = ("position", "velocity", "acceleration", "effort")
"""Standard joint interfaces of hardware_interface in ros2_control."""

_PARTS: dict[str, tuple[str, ...]] = {
    "transmission": ("type", "joint", "actuator", "plugin", "role"),
    "transmission/joint": ("hardwareInterface", "mechanicalReduction", "offset", "role"),
    "transmission/actuator": ("hardwareInterface", "mechanicalReduction", "role"),
    "ros2_control": ("hardware", "joint", "sensor", "gpio", "transmission"),
    "ros2_control/hardware": ("plugin", "param", "group"),
    "ros2_control/joint": ("command_interface", "state_interface", "param", "limits"),
    "ros2_control/sensor": ("state_interface", "param"),
    "ros2_control/gpio": ("command_interface", "state_interface", "param"),
}
"""Valid child elements by path (transmission_interface's parser; component_parser.cpp of hardware_interface)."""

_OTHERS = frozenset(("motor", "effort", "reduction", "joints", "sensors", "actuators", "types"))
"""Custom names that are not misspellings."""


def misspelt_parts(element: Element, where: str) -> Iterator[tuple[Element, Element, str]]:
    """Yield the misspelt elements in a ``<transmission>`` or ``<ros2_control>``: parent, child, correct name.

    Custom elements are allowed; an element is misspelt only if its name is similar to a standard one.

    Args:
        element: a transmission, a block of ros2_control, or a part of one.
        where: path of element names.
    """
    allowed = _PARTS.get(where)
    if allowed is None:
        return
    for child in element.children:
        if child.tag in allowed:
            yield from misspelt_parts(child, f"{where}/{child.tag}")
        elif ":" not in child.tag and child.tag not in _OTHERS:
            meant = nearest(child.tag, allowed, cutoff=0.8)
            if meant is not None:
                yield element, child, meant


def written(robot: Robot) -> Iterator[tuple[str, Element, Transmission]]:
    """Yield the text, the element and the transmission of every ``<hardwareInterface>``."""
    for transmission in robot.transmissions:
        parts = [part.element for part in transmission.joints] + [part.element for part in transmission.actuators]
        for part in parts:
            for child in part.find_all("hardwareInterface"):
                if child.text and "$" not in child.text:
                    yield child.text, child, transmission


def is_misspelt(name: str) -> bool:
    """Return whether a hardware interface, without its package, is misspelt."""
    return name not in INTERFACES and nearest(name, INTERFACES, cutoff=0.85) is not None


def meant_interface(name: str) -> str | None:
    """Return the standard ros2_control interface that a misspelt name stands for; None for a valid name."""
    return nearest(name, STANDARD, cutoff=0.85) if name not in STANDARD else None


def meant_joints(robot: Robot) -> set[str]:
    """Return the joints most similar to the undefined joint names in the robot's ``<ros2_control>``."""
    joints = robot.joint_by_name
    named = (part.get("name") or "" for block in robot.ros2_control for part in block.element.find_all("joint"))
    return {near for name in named if name not in joints and (near := meant(name, joints)[0]) is not None}


def is_old(transmission: Transmission) -> bool:
    """Return whether a transmission has the old form of the PR2, with its type in an attribute."""
    return transmission.element.find("type") is None and transmission.element.get("type") is not None


def has_default_hardware(robot: Robot) -> bool:
    """Return whether the robot has the plugin gazebo_ros_control with its default hardware, DefaultRobotHWSim."""
    found = (plugin.element for plugin, _, _ in plugins(robot) if "gazebo_ros_control" in (plugin.filename or ""))
    kinds = (element.find("robotSimType") for element in found)
    return any(kind is None or kind.text.endswith("DefaultRobotHWSim") for kind in kinds)


def has_gazebo_ros_control(robot: Robot) -> bool:
    """Return whether the robot has the plugin gazebo_ros_control, which reads transmissions."""
    return any("gazebo_ros_control" in (plugin.filename or "") for plugin, _, _ in plugins(robot))
