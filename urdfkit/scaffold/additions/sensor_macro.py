"""Sensors of the robot template as xacro macros with name, parent, topic and update rate as parameters."""

import re
from dataclasses import dataclass
from pathlib import Path

from urdfkit.file_replacement import read_bytes
from urdfkit.resources import templates_dir

PARAMETERS = "name parent topic update_rate *origin"
GENERATIONS = ("gz", "classic", "classic-ros2")
"""Gazebo Sim, Gazebo Classic with ROS 1, and Gazebo Classic with ROS 2: folders of the robot template."""

_SEVERAL = ("camera", "depth", "lidar3d")
"""Sensors whose topic is a prefix of several topics."""

_COLOURS = {"black": "0.12 0.12 0.13 1", "grey": "0.60 0.62 0.65 1"}
_TOPICS = ("topic", "topicName", "velocityTopicName", "cameraName", "camera_name", "remapping")


@dataclass(frozen=True, slots=True)
class SensorKind:
    """A kind of sensor that can be added.

    Attributes:
        about: description.
        topic: topic in the template; for cameras and `lidar3d` the prefix of several topics.
        rate: default measurements per second.
        spot: default place on the link: ``top``, ``front`` or ``middle``.
        needs: package of its plugin for Gazebo Classic with ROS 1.
        needs_ros2: package of its plugin for Gazebo Classic with ROS 2.
        needs_free_view: whether neighbouring parts at the same height block its view.
    """

    about: str
    topic: str
    rate: float
    spot: str
    needs: str = "gazebo_plugins"
    needs_ros2: str = "gazebo_plugins"
    needs_free_view: bool = False


KINDS = {
    "lidar": SensorKind("a lidar with one plane of 270°", "scan", 10, "top", needs_free_view=True),
    "lidar3d": SensorKind("a lidar with 16 planes, on a mast", "lidar3d", 10, "top", "velodyne_gazebo_plugins"),
    "camera": SensorKind("a camera", "camera", 30, "front"),
    "depth": SensorKind("a depth camera", "depth", 15, "front"),
    "imu": SensorKind("an inertial measurement unit", "imu", 100, "middle"),
    "gps": SensorKind("a GPS receiver", "fix", 5, "top", "hector_gazebo_plugins"),
}


def topic_of(kind: str, name: str) -> str:
    """Return the default topic of a sensor.

    Args:
        kind: a key of `KINDS`.
        name: name of the sensor.
    """
    topic = KINDS[kind].topic
    if name == kind:
        return topic
    return name if kind in _SEVERAL else f"{name}/{topic}"


def sensor_macro(kind: str, generation: str) -> str:
    """Return the text of the file with the macro ``KIND_sensor``.

    Args:
        kind: a key of `KINDS`.
        generation: one of `GENERATIONS`.

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
    # Without a namespace, only some of these plugins publish below the model's name.
    text = re.sub(r"(<robotNamespace>)[^<]*", r"\1/", text)
    text = re.sub(r"(<(update_rate|updateRate|updateRateHZ)>)[^<]*", r"\1${update_rate}", text)
    lines = "\n".join(f"  {line}" if line.strip() else "" for line in text.strip("\n").splitlines())
    about = KINDS[kind].about.capitalize()
    return (
        '<?xml version="1.0"?>\n'
        f"<!-- {about}. topic: {_topic_help(kind)}; update_rate [1/s]; origin: in the parent's frame. -->\n"
        '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
        f'  <xacro:macro name="{kind}_sensor" params="{PARAMETERS}">\n'
        f"{lines}\n"
        "  </xacro:macro>\n"
        "</robot>\n"
    )


def bridge_entries(kind: str, topic: str, messages: str) -> str:
    """Return the entries of ros_gz_bridge's configuration for a sensor.

    Args:
        kind: a key of `KINDS`.
        topic: topic of the sensor.
        messages: ``gz.msgs`` or ``ignition.msgs``.

    Raises:
        ResourceError: the installation is incomplete.
    """
    path = templates_dir() / f"robot/ros2-gz-sensors/{kind}/@name@_gazebo/config/bridge.yaml"
    text = read_bytes(path).decode("utf-8")
    text = re.sub(rf"(?m)(_topic_name: ){KINDS[kind].topic}(?=/|$)", rf"\g<1>{topic.lstrip('/')}", text)
    return text.replace("@gz_msgs@", messages)


def _topic_help(kind: str) -> str:
    return "prefix of its topics" if kind in _SEVERAL else "the topic it publishes"


def _inside(path: Path) -> str:
    """Return the text between ``<robot …>`` and ``</robot>``."""
    text = read_bytes(path).decode("utf-8")
    return text[text.index(">", text.index("<robot")) + 1 : text.rindex("</robot>")]


def _named(text: str, kind: str) -> str:
    """Return the text with the sensor's name and topic replaced by parameters."""
    base = KINDS[kind].topic
    text = re.sub(rf"\b{kind}(?=_link\b|_joint\b|_optical_)", "${name}", text)
    text = re.sub(rf'(<(?:sensor|plugin) name="){kind}"', r'\1${name}"', text)

    def topic(match: re.Match[str]) -> str:
        value = re.sub(rf"(^|:=){base}(?=/|_velocity|:=|$)", r"\1${topic}", match[2])
        return f"{match[1]}{value}"

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
