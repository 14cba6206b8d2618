"""The hardware interfaces of ros_control, and where transmissions name them."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.description.robot import Robot, Transmission

PACKAGE = "hardware_interface"
"""What stands before the slash."""

INTERFACES = (
    "EffortJointInterface",
    "VelocityJointInterface",
    "PositionJointInterface",
    "PosVelJointInterface",
    "PosVelAccJointInterface",
    "JointStateInterface",
    "JointCommandInterface",
    "ActuatorStateInterface",
    "ForceTorqueSensorInterface",
    "ImuSensorInterface",
    "JointModeInterface",
)
"""The interfaces that hardware_interface has in ROS Noetic."""


def written(robot: Robot) -> Iterator[tuple[str, Element, Transmission]]:
    """Yield every ``<hardwareInterface>``: its text, its element and the transmission it is in."""
    for transmission in robot.transmissions:
        parts = [part.element for part in transmission.joints] + [part.element for part in transmission.actuators]
        for part in parts:
            for child in part.find_all("hardwareInterface"):
                if child.text and "$" not in child.text:
                    yield child.text, child, transmission


def is_old(transmission: Transmission) -> bool:
    """Whether a transmission is written as PR2's were: its type in an attribute."""
    return transmission.element.find("type") is None and transmission.element.get("type") is not None


def has_gazebo_ros_control(robot: Robot) -> bool:
    """Whether the robot brings the plugin that reads transmissions."""
    from urdfkit.lint.gazebo import plugins

    return any("gazebo_ros_control" in (plugin.filename or "") for plugin, _, _ in plugins(robot))
