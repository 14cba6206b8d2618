"""ROS version that reads an XML launch file."""

import re
from pathlib import Path

from urdfkit.description.packages.kept_files import kept
from urdfkit.description.packages.related_files import manifest, package_of, uncommented
from urdfkit.description.xml.source import Source

_ROS1 = r"\$\((?:find|arg|optenv)\s|<rosparam\b|<node\b[^<>]*\stype\s*="
_ROS2 = r"\$\((?:find-pkg-\w+|var|find-exec)\s|<let\b|<node\b[^<>]*\sexec\s*="
_MANY = 3


@kept
def ros_version(source: Source) -> int:
    """Return 1 or 2 by the build tool of the package, else by the words of the file; 0 if these contradict."""
    text = uncommented(source.text)
    ros1, ros2 = (len(re.findall(pattern, text)) for pattern in (_ROS1, _ROS2))
    package = package_of(Path(source.file))
    tools = set(re.findall(r">\s*(catkin|ament)(?:_\w+)?\s*<", manifest(package))) if package is not None else set()
    if len(tools) != 1:
        return 0 if ros1 == ros2 or min(ros1, ros2) else 1 if ros1 else 2
    if tools == {"catkin"}:
        return 0 if not ros1 and ros2 >= _MANY else 1
    return 0 if not ros2 and ros1 >= _MANY else 2


def reads_version(source: Source) -> int:
    """Return the ROS version that reads a launch file, or 0 if its words contradict; ROS 2 reads Python."""
    return 2 if source.file.endswith(".py") else ros_version(source)


def reads_ros1(source: Source) -> bool:
    """Return whether roslaunch reads an XML launch file; by the suffix and ROS 2 words if its words contradict."""
    version = ros_version(source)
    return version == 1 or (version == 0 and source.file.endswith(".launch") and re.search(_ROS2, source.text) is None)
