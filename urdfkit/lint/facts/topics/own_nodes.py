"""The messages that the nodes in the packages of a workspace publish and read, by their code in Python or C++.

The calls are those of rclpy, rospy, rclcpp and roscpp.
"""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.launch.python_constants import name_of
from urdfkit.description.packages.kept_files import kept
from urdfkit.description.packages.related_files import neighbours
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts, python_tree

CLIENTS = r"\brclpy\b|\brospy\b|\brclcpp\b|\bros/ros\.h\b"
"""Matches code that uses a client library of ROS."""

_OTHER_PUBLISHERS = (
    r"image_transport|point_cloud_transport|camera_info_manager|generic_publisher|AdvertiseOptions|rosbag|topic_tools"
)
"""Matches code that publishes in another way, or on topics that it computes."""

_IN_CPP = r"\b(?:{})\b\s{{0,80}}(?:<([\w:\s]{{1,200}})>\s{{0,80}})?\(\s{{0,80}}(?:\"([\w/~]+)\")?"
_PUBLISHERS = ("create_publisher", "create_lifecycle_publisher", "Publisher", "advertise")
_SUBSCRIBERS = ("create_subscription", "Subscriber", "subscribe")
_SENSOR_MESSAGES = (
    *("LaserScan", "PointCloud2", "PointCloud", "Odometry", "Imu", "Image", "Range", "NavSatFix"),
    *("PoseWithCovarianceStamped", "TwistWithCovarianceStamped"),
)


def own_folder(model: Model, package: str) -> Path | None:
    """Return the folder of a package of the workspace, which is then watched; None if it is not in the workspace."""
    folder = neighbours(model.package).get(package) if model.package is not None else None
    if folder is not None:
        model.expanded.packages.watch(folder)
    return folder


@kept
def own_publications(model: Model, package: str) -> list[tuple[str, str]] | None:
    """Return topic and type without package of the sensor messages and odometry that a package publishes.

    None if the package is not in the workspace, or if its code may publish other topics of these types.
    """
    folder = own_folder(model, package)
    if folder is None:
        return None
    found: list[tuple[str, str]] = []
    is_read = False
    for path, text in node_texts(folder):
        is_read |= re.search(CLIENTS, text) is not None
        if re.search(_OTHER_PUBLISHERS, text):
            return None
        pairs = _in_python(text, _PUBLISHERS) if path.name.endswith(".py") else _in_cpp(text, _PUBLISHERS)
        for kind, topic in pairs:
            if kind is None or (topic is None and kind in _SENSOR_MESSAGES):
                return None
            if topic is not None and kind in _SENSOR_MESSAGES:
                found.append((topic.strip("/"), kind))
    return found if is_read else None


@kept
def own_subscriptions(model: Model, package: str) -> dict[str, str]:
    """Return topic → type without package of the sensor messages and odometry that the code of a package reads.

    Topics with computed names or types are missing.
    """
    folder = own_folder(model, package)
    if folder is None:
        return {}
    found: dict[str, str] = {}
    for path, text in node_texts(folder):
        pairs = _in_python(text, _SUBSCRIBERS) if path.name.endswith(".py") else _in_cpp(text, _SUBSCRIBERS)
        found |= {topic.strip("/"): kind for kind, topic in pairs if topic and kind in _SENSOR_MESSAGES}
    return found


def _in_python(text: str, functions: tuple[str, ...]) -> Iterator[tuple[str | None, str | None]]:
    """Yield type and topic of each call of functions; None for a computed name, and a type None for a syntax error."""
    tree = python_tree(text)
    if tree is None:
        yield None, None
        return
    imports = (node for node in ast.walk(tree) if isinstance(node, ast.ImportFrom))
    messages = {
        name.asname or name.name: name.name
        for node in imports
        for name in node.names
        if (node.module or "").endswith(".msg")
    }
    for call in (node for node in ast.walk(tree) if isinstance(node, ast.Call)):
        words = {word.arg: word.value for word in call.keywords}
        if name_of(call.func) not in functions:
            continue
        if name_of(call.func).startswith("create_"):
            values = [*call.args, words.get("msg_type"), words.get("topic")][:2]
            kind, topic = (words.get("msg_type", values[0]), words.get("topic", values[1]))
        elif isinstance(call.func, ast.Name) or getattr(getattr(call.func, "value", None), "id", "") == "rospy":
            values = [*call.args, None, None][:2]
            topic, kind = words.get("name", values[0]), words.get("data_class", values[1])
        else:
            continue
        name = messages.get(kind.id) if isinstance(kind, ast.Name) else None
        name = kind.attr if isinstance(kind, ast.Attribute) else name
        written = topic.value if isinstance(topic, ast.Constant) else None
        yield name, written if isinstance(written, str) else None


def _in_cpp(text: str, functions: tuple[str, ...]) -> Iterator[tuple[str | None, str | None]]:
    """Yield type and topic of each call of functions; None for a computed name."""
    used = {at[1] for at in re.finditer(r"\busing\s{1,9}[\w:]{1,200}?::(\w{1,80})\s{0,9};", text)}
    for at in re.finditer(_IN_CPP.format("|".join(functions)), text):
        kind = (at[1] or "").strip()
        name = kind.rpartition("::")[2]
        is_message = "::" in kind or name in used
        yield (name if name and is_message else None), at[2]
