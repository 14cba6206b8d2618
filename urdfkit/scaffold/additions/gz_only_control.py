"""Control without ROS: Gazebo plugins that subscribe to Gazebo topics, as in the robot template without ROS."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.urdf.robot import Robot
from urdfkit.scaffold.additions.joint_controllers import ChosenController

_RECIPE = "urdfkit-new.toml"
_NONE = re.compile(r'(?m)^ros\s*=\s*"none"')
_RATE = 1.0
"""Velocity of a joint without a velocity limit [rad/s or m/s]."""


def is_without_ros(path: Path) -> bool:
    """Return whether a description was created for use without ROS, by the recipe of its package.

    A recipe counts only if no ``package.xml`` is nearer to the description.

    Args:
        path: the description.
    """
    for folder in path.resolve().parents:
        if (folder / "package.xml").is_file():
            return False
        if (folder / _RECIPE).is_file():
            return _NONE.search((folder / _RECIPE).read_text("utf-8", "replace")) is not None
    return False


def topics(controllers: list[ChosenController]) -> dict[str, str]:
    """Return the command topic of each joint: one for a drive or a gripper, otherwise one per joint.

    Args:
        controllers: the controllers.
    """
    topic_of = {}
    for each in controllers:
        name = each.name.removesuffix("_controller")
        for joint in each.joints:
            whole = each.wheels is not None or name.startswith("gripper")
            topic = "cmd_vel" if each.wheels else name
            topic_of[joint] = topic if whole else f"{name}/{joint.removesuffix('_joint')}"
    return topic_of


def plugins(robot: Robot, controllers: list[ChosenController]) -> str:
    """Return the plugin elements of the model, without indentation.

    Args:
        robot: the robot that is controlled.
        controllers: the controllers.
    """
    topic_of = topics(controllers)
    lines: list[str] = []
    for each in controllers:
        if each.wheels is not None:
            lines += _drive(each)
            continue
        for joint in each.joints:
            limit = robot.joint_by_name[joint].limit
            rate = limit.velocity if limit is not None else None
            lines += _positioned(joint, topic_of[joint], rate or _RATE)
    return "\n".join(lines)


def _drive(each: ChosenController) -> Iterator[str]:
    wheels = each.wheels
    if wheels is None:
        return
    yield "<gazebo>"
    yield '  <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">'
    for side, joints in (("left", wheels.left), ("right", wheels.right)):
        yield from (f"    <{side}_joint>{joint}</{side}_joint>" for joint in joints)
    yield f"    <wheel_separation>{wheels.separation:.6g}</wheel_separation>"
    yield f"    <wheel_radius>{wheels.radius:.6g}</wheel_radius>"
    yield "    <topic>cmd_vel</topic>"
    yield "    <odom_topic>odom</odom_topic>"
    yield "  </plugin>"
    yield "</gazebo>"


def _positioned(joint: str, topic: str, rate: float) -> Iterator[str]:
    yield "<gazebo>"
    name = "gz::sim::systems::JointPositionController"
    yield f'  <plugin filename="gz-sim-joint-position-controller-system" name="{name}">'
    yield f"    <joint_name>{joint}</joint_name>"
    yield f"    <topic>{topic}</topic>"
    yield "    <use_velocity_commands>true</use_velocity_commands>"
    yield f"    <cmd_max>{rate:.6g}</cmd_max>"
    yield f"    <cmd_min>{-rate:.6g}</cmd_min>"
    yield "  </plugin>"
    yield "</gazebo>"
