"""The sensors of new robots as macros: the same files, with names, topic and rate as parameters."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

from urdfkit.errors import ResourceError
from urdfkit.resources import templates_dir

PARAMETERS = "name parent topic update_rate *origin"
GENERATIONS = ("gz", "classic", "classic-ros2")
"""The new Gazebo, Gazebo Classic with ROS 1, and with ROS 2: folders of the robot's template."""

_SEVERAL = ("camera", "depth", "lidar3d")
"""Sensors with topics below the one they are told."""

_COLOURS = {"black": "0.12 0.12 0.13 1", "grey": "0.60 0.62 0.65 1"}
_TOPICS = ("topic", "topicName", "velocityTopicName", "cameraName", "camera_name", "remapping")


@dataclass(frozen=True, slots=True)
class Kind:
    """A sensor that can be added.

    Attributes:
        about: what it is.
        topic: what the template publishes under; of cameras and of `lidar3d` the beginning of several.
        rate: measurements per second.
        spot: where on its link it goes by default: ``top``, ``front`` or ``middle``.
        needs: what its plugin of Gazebo Classic for ROS 1 is in.
        needs_ros2: the same for ROS 2.
        looks_about: whether it sees along what it stands on, so that others beside it are in its way.
    """

    about: str
    topic: str
    rate: float
    spot: str
    needs: str = "gazebo_plugins"
    needs_ros2: str = "gazebo_plugins"
    looks_about: bool = False


KINDS = {
    "lidar": Kind("a lidar of one plane, 270°", "scan", 10, "top", looks_about=True),
    "lidar3d": Kind("a lidar of 16 planes on a mast", "lidar3d", 10, "top", "velodyne_gazebo_plugins"),
    "camera": Kind("a camera", "camera", 30, "front"),
    "depth": Kind("a camera that sees depth", "depth", 15, "front"),
    "imu": Kind("an inertial measurement unit", "imu", 100, "middle"),
    "gps": Kind("a receiver for GPS", "fix", 5, "top", "hector_gazebo_plugins"),
}


def topic_of(kind: str, name: str) -> str:
    """Return the topic of a sensor that nobody named one for.

    Args:
        kind: of `KINDS`.
        name: of the sensor.
    """
    topic = KINDS[kind].topic
    if name == kind:
        return topic
    return name if kind in _SEVERAL else f"{name}/{topic}"


def sensor_macro(kind: str, generation: str) -> str:
    """Return the file with the macro ``KIND_sensor``.

    Args:
        kind: of `KINDS`.
        generation: of `GENERATIONS`.

    Raises:
        ResourceError: the installation is incomplete.
    """
    home = templates_dir() / "robot"
    tail = Path("sensors") / kind / "@name@_description/urdf/sensors"
    body = _inside(home / tail / f"{kind}.xacro")
    gazebo = _inside(home / generation / tail / f"{kind}_gazebo.xacro")
    body = re.sub(r"\n *<xacro:include [^>]*/>", "", body)
    body = re.sub(r'<parent link="base_link"/>', '<parent link="${parent}"/>', body)
    body = re.sub(r"<origin [^>]*/>", '<xacro:insert_block name="origin"/>', body, count=1)
    body = re.sub(r'<material name="(\w+)"/>', lambda match: _material(kind, match[1]), body)
    body = re.sub(r"<xacro:box_inertial ([^>]*)>\s*(<origin [^>]*/>)\s*</xacro:box_inertial>", _inertial, body)
    text = _named(f"{body.rstrip()}\n\n{gazebo.strip(chr(10)).rstrip()}", kind)
    # Without it, some of these plugins publish below the model's name and some do not.
    text = re.sub(r"(<robotNamespace>)[^<]*", r"\1/", text)
    text = re.sub(r"(<(update_rate|updateRate|updateRateHZ)>)[^<]*", r"\1${update_rate}", text)
    lines = "\n".join(f"  {line}" if line.strip() else "" for line in text.strip("\n").splitlines())
    about = KINDS[kind].about.capitalize()
    return (
        '<?xml version="1.0"?>\n'
        f"<!-- {about}. topic: {_topic_says(kind)}; update_rate [1/s]; origin: in the parent. -->\n"
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'  <xacro:macro name="{kind}_sensor" params="{PARAMETERS}">\n'
        f"{lines}\n"
        "  </xacro:macro>\n"
        "</robot>\n"
    )


def bridge_entries(kind: str, topic: str, messages: str) -> str:
    """Return what ros_gz_bridge has to be told about a sensor: entries of its YAML.

    Args:
        kind: of `KINDS`.
        topic: of the sensor.
        messages: ``gz.msgs`` or ``ignition.msgs``.

    Raises:
        ResourceError: the installation is incomplete.
    """
    path = templates_dir() / f"robot/ros2-gz-sensors/{kind}/@name@_gazebo/config/bridge.yaml"
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error
    text = re.sub(rf"(?m)(_topic_name: ){KINDS[kind].topic}(?=/|$)", rf"\g<1>{topic.lstrip('/')}", text)
    return text.replace("@gz_msgs@", messages)


def _topic_says(kind: str) -> str:
    return "what its topics begin with" if kind in _SEVERAL else "where it publishes"


def _inside(path: Path) -> str:
    """Return what is between ``<robot …>`` and ``</robot>``."""
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise ResourceError(f"{path}: {error.strerror}") from error
    return text[text.index(">", text.index("<robot")) + 1 : text.rindex("</robot>")]


def _named(text: str, kind: str) -> str:
    """Return the text with the sensor's name and topic as parameters."""
    base = KINDS[kind].topic
    text = re.sub(rf"\b{kind}(?=_link\b|_joint\b|_optical_)", "${name}", text)
    text = re.sub(rf'(<(?:sensor|plugin) name="){kind}"', r'\1${name}"', text)

    def topic(match: re.Match[str]) -> str:
        said = re.sub(rf"(^|:=){base}(?=/|_velocity|:=|$)", r"\1${topic}", match[2])
        return f"{match[1]}{said}"

    text = re.sub(rf"(<(?:{'|'.join(_TOPICS)})>)([^<]*)", topic, text)
    return re.sub(r"@name@/?", "", text)


def _material(kind: str, colour: str) -> str:
    return f'<material name="{kind}_sensor_{colour}">\n        <color rgba="{_COLOURS[colour]}"/>\n      </material>'


def _inertial(match: re.Match[str]) -> str:
    mass, x, y, z = (float(value) for value in re.findall(r'"([^"]*)"', match[1]))
    moments = [mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)]
    xx, yy, zz = (f"{moment:.6g}" for moment in moments)
    return (
        f"<inertial>\n      {match[2]}\n"
        f'      <mass value="{mass:g}"/>\n'
        f'      <inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/>\n'
        "    </inertial>"
    )
