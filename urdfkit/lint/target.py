"""What a robot is meant for, guessed from the package.xml of its package."""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.record import record

_COMMENT = r"(?s)<!--.*?(?:-->|\Z)"
_BUILD = r"<build(?:tool_depend|_type)\b[^>]*>\s*([\w.-]+)\s*<"
_NEEDS = r"<(?:\w*depend|name)\b[^>]*>\s*([\w.-]+)\s*<"

_ROS = {
    "catkin": "ros1",
    "ament_cmake": "ros2",
    "ament_cmake_auto": "ros2",
    "ament_cmake_python": "ros2",
    "ament_python": "ros2",
}
"""Build tool or type → the ROS that has it (REP-149, and the build types of colcon)."""

_ONLY_ROS = {
    "roslaunch": "ros1",
    "rospy": "ros1",
    "roscpp": "ros1",
    "launch_ros": "ros2",
    "rclpy": "ros2",
    "rclcpp": "ros2",
}
"""Packages of one ROS only: they count where the build tool says nothing."""

_NEW_GAZEBO = ("ros_gz", "gz_ros2_control", "ign_ros2_control", "ros_ign", "gz_sim_vendor", "gz-sim", "ignition-gazebo")
_CLASSIC = ("gazebo_ros", "gazebo_plugins", "gazebo_ros2_control", "gazebo_dev", "gazebo_rosdev")


@record
class Guess:
    """What a package is for.

    Attributes:
        target: ``ros1``, ``ros2``, ``gz``, or None where package.xml does not tell, or tells of several.
        why: what it was guessed from, for the reader.
        manifest: the package.xml; None where there is none.
    """

    target: str | None
    why: str
    manifest: Path | None


def guess(path: Path) -> Guess:
    """Guess the target of a description file from the package.xml above it.

    A package that needs the new Gazebo and not the classic one is for ``gz``; else the build tool tells ROS 1 and 2.
    """
    above = (folder / "package.xml" for folder in path.absolute().parents)
    manifest = next((file for file in above if file.is_file()), None)
    if manifest is None:
        return Guess(None, "no package.xml", None)
    try:
        text = re.sub(_COMMENT, "", manifest.read_text("utf-8", "replace"))
    except OSError:
        return Guess(None, "package.xml cannot be read", None)
    needs = re.findall(_NEEDS, text)
    new = next((name for name in needs if name.startswith(_NEW_GAZEBO)), None)
    if new is not None and not any(name.startswith(_CLASSIC) for name in needs):
        return Guess("gz", f"depends on {new}", manifest)
    tools = [name for name in re.findall(_BUILD, text) if name in _ROS]
    versions = {_ROS[tool] for tool in tools}
    if len(versions) == 1:
        return Guess(versions.pop(), f"is built with {tools[0]}", manifest)
    known = [name for name in needs if name in _ONLY_ROS]
    others = {_ONLY_ROS[name] for name in known}
    if not versions and len(others) == 1:
        return Guess(others.pop(), f"depends on {known[0]}", manifest)
    return Guess(None, "is for ROS 1 and ROS 2" if len(versions | others) > 1 else "names no build tool", manifest)
