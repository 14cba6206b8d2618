"""Remappings of the nodes in the packages of a workspace whose old name the code of the package does not have.

The calls with names of topics, services and actions are those of rclpy, rospy, rclcpp, roscpp, actionlib and
message_filters.
"""

import ast
import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import name_of
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes
from urdfkit.lint.facts.topics.own_nodes import CLIENTS, own_folder
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts, python_tree

_EVERY_NODE = ("tf", "tf_static", "clock", "rosout", "parameter_events", "diagnostics", "robot_description")
"""Topics that libraries read and publish in nodes that do not name them."""

_PLACES = {
    **dict.fromkeys(("create_publisher", "create_lifecycle_publisher", "create_subscription"), (1, "topic")),
    **dict.fromkeys(("create_service", "create_client"), (1, "srv_name")),
    **dict.fromkeys(("Publisher", "Subscriber", "Service", "ServiceProxy", "wait_for_message"), (0, "name")),
    **dict.fromkeys(("SimpleActionClient", "SimpleActionServer"), (0, "name")),
    **dict.fromkeys(("ActionClient", "ActionServer"), (2, "action_name")),
}
"""Function or class → place and keyword of the name."""

_BASES = (
    *("ABC", "Enum", "Exception", "Generic", "IntEnum", "LifecycleNode", "NamedTuple", "Node", "Protocol", "Thread"),
    *("TypedDict", "object"),
)
"""Base classes that name no topics."""

_MODULES = (
    r"\b(?:moveit_commander|moveit|nav2_simple_commander|image_transport|smach_ros|py_trees_ros|joy_teleop"
    r"|dynamic_reconfigure|point_cloud_transport|camera_info_manager|AdvertiseOptions|SubscribeOptions|topic_tools"
    r"|generic_publisher|generic_subscription|pluginlib|hardware_interface|controller_interface)\b"
)
"""Matches code whose libraries have topics that it does not name."""

_CALL_IN_CPP = (
    r"\b(?:create_publisher|create_subscription|create_service|create_client|create_server|advertise|advertiseService"
    r"|subscribe|serviceClient|SimpleActionClient|SimpleActionServer)\b\s{0,80}(?:<[\w:\s,<>]{1,200}>)?\s{0,80}\("
    r"(?:\s{0,80}(?:this|shared_from_this\(\)|\*?node_?|nh_?|n_?)\s{0,20},)?\s{0,80}(?:\"([\w/~]+)\"\s{0,80}[,)])?"
)
_BASE_IN_CPP = r"\bclass\s{1,20}\w{1,80}[^;{}]{0,20}:\s{0,20}public\s{1,20}([\w:]{1,120})"
_BASES_IN_CPP = r"(?:::)?(?:rclcpp::Node|rclcpp_lifecycle::LifecycleNode|nodelet::Nodelet|nav2_util::LifecycleNode)"


def misnamed_in_code(model: Model) -> Iterator[tuple[Source, Named, str]]:
    """Yield the launch file, the old name and the message of each remapping that has no effect on an own node."""
    names: dict[str, frozenset[str] | None] = {}
    for node in launched_nodes(model):
        if not node.remappings or not node.package:
            continue
        if node.package not in names:
            names[node.package] = _names(model, node.package)
        own = names[node.package]
        yield from ((node.source, *each) for each in _misnamed(node, own)) if own else ()


def _misnamed(node: LaunchedNode, names: frozenset[str]) -> Iterator[tuple[Named, str]]:
    written = {_plain(old.name) for old, _ in node.remappings}
    lasts = {name.rpartition("/")[2] for name in names}
    for old, new in node.remappings:
        name, other = _plain(old.name), _plain(new.name)
        is_part = any(name.startswith(f"{each}/") for each in names) or (
            "/" in name and name.rpartition("/")[2] in lasts
        )
        if not re.fullmatch(r"[\w/]+", name) or name in names or name in _EVERY_NODE:
            continue
        if other in names and other not in written and not old.name.startswith("/"):
            yield old, f"the code of `{node.package}` names the topic `{other}`, not `{name}`; swap the names"
            continue
        if is_part:  # a topic of the node in a namespace, or of image_transport
            continue
        left = sorted(names - written)
        near = next((each for each in left if each == other.rpartition("/")[2]), None) or nearest(
            name, left, cutoff=0.6
        )
        yield old, f"the code of `{node.package}` does not name `{name}`" + Suggestion(near, old.name)


def _plain(name: str) -> str:
    return name.removeprefix("~").strip("/")


def _names(model: Model, package: str) -> frozenset[str] | None:
    """Return the names of topics, services and actions in the code of a package of the workspace.

    None if the package is not in the workspace, or if its code may have other names.
    """
    folder = own_folder(model, package)
    if folder is None:
        return None
    found = set[str]()
    for path, text in node_texts(folder):
        if not re.search(CLIENTS, text):
            continue
        names = list(_in_python(text) if path.name.endswith(".py") else _in_cpp(text))
        if None in names or re.search(_MODULES, text):
            return None
        found.update(_plain(name) for name in names if name is not None)
    return frozenset(found)


def _in_python(text: str) -> Iterator[str | None]:
    """Yield the names in the code of a module; None for computed names, and for other base classes."""
    tree = python_tree(text)
    if tree is None:
        yield None
        return
    own = {node.name for node in ast.walk(tree) if isinstance(node, ast.ClassDef)}
    for node in ast.walk(tree):
        if isinstance(node, ast.ClassDef) and any(name_of(base) not in (*_BASES, *own) for base in node.bases):
            yield None
        elif isinstance(node, ast.Call) and name_of(node.func) in _PLACES:
            at, word = _PLACES[name_of(node.func)]
            if any(getattr(each, "id", "") == "message_filters" for each in ast.walk(node.func)):
                at = max(len(node.args) - 1, 0) if len(node.args) > 2 else at
            words = {each.arg: each.value for each in node.keywords}
            value = words.get(word) or (node.args[at] if at < len(node.args) else None)
            written = value.value if isinstance(value, ast.Constant) else None
            yield written if isinstance(written, str) else None


def _in_cpp(text: str) -> Iterator[str | None]:
    """Yield the names in a file of C++; None for computed names, and for other base classes."""
    if any(not re.fullmatch(_BASES_IN_CPP, base[1]) for base in re.finditer(_BASE_IN_CPP, text)):
        yield None
    for call in re.finditer(_CALL_IN_CPP, text):
        yield call[1]
