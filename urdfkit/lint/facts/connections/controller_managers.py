"""Controller managers that the launch files and the robot start, and spawners that name another one.

Sources: ros2_control (controller_manager/controller_manager/spawner.py: a relative name is below the namespace of the
spawner) and gz_ros2_control (src/gz_ros2_control_plugin.cpp: the namespace and ``controller_manager_name``).
"""

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.launch_scope import UNKNOWN, LaunchContents, LaunchNode, PlacedText
from urdfkit.description.xml.source import Span
from urdfkit.lint.facts.connections.trees import (
    full_name,
    is_constant,
    is_ros1,
    launch_trees,
    place_of,
    source_of,
    span_in,
)
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.fix_builders import nearest
from urdfkit.lint.model.model import Model

_DEFAULT = "controller_manager"
_SPAWNERS = ("spawner", "spawner.py", "unspawner", "hardware_spawner")
_OPTIONS = ("-c", "--controller-manager")
_PLUGIN = "ros2_control"
_OTHERS = r"webots|mujoco|isaac|unity|controller_manager::ControllerManager"
"""Matches files of workspaces in which another program can contain a controller manager."""

WITHOUT_MANAGER = (
    "gazebo_ros",
    "ros_gz_sim",
    "ros_ign_gazebo",
    "ros_gz_bridge",
    "nav2_bringup",
    "slam_toolbox",
    "rviz2",
)
"""Packages whose launch files start no controller manager."""


def misdirected_spawners(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield place and message of each spawner whose controller manager no launch file and no plugin starts.

    If all spawners of a launch name another manager than the only one, yields the manager.
    """
    of_plugins = _of_plugins(model)
    trees = [(tree, _managers(tree)) for tree in launch_trees(model) if not is_ros1(tree, model)]
    every = [name for _, managers in trees for name in managers]
    if of_plugins is None or not all(is_constant(name) for name in every) or _may_have_others(model):
        return
    seen = set[tuple[str, int]]()
    for tree, managers in trees:
        for span, message in _misdirected(tree, managers, frozenset((*(managers or every), *of_plugins)), model):
            if (span.file, span.line) not in seen:
                seen.add((span.file, span.line))
                yield span, message


def _misdirected(
    tree: LaunchContents, managers: dict[str, LaunchNode], started: frozenset[str], model: Model
) -> Iterator[tuple[Span, str]]:
    """Yield place and message of the first spawner of each name without a manager, or of a manager without spawners.

    Args:
        tree: the launch.
        managers: the managers that it starts.
        started: these, and those of plugins; of all launch files if it starts none.
        model: the linted model.
    """
    spawners = [node for node in tree.nodes if node.package == _DEFAULT and node.program in _SPAWNERS]
    wanted = [(node, each, full_name(node, each.text)) for node in spawners if (each := manager_of(node)) is not None]
    missed = [each for each in wanted if each[2] not in started]
    names = {name for _, _, name in missed}
    if not started or not missed:
        return
    if len(names) == len(started) == len(managers) == 1 and len(wanted) == len(missed) == len(spawners):
        (name, manager), (other,) = next(iter(managers.items())), names
        spaces = Counter(node.namespace for node in tree.nodes)
        span = place_of(manager, model)
        is_renamed = manager.name not in ("", _DEFAULT)
        if span is not None and (is_renamed or spaces[manager.namespace] < spaces[spawners[0].namespace]):
            yield span, f"this controller manager is called `/{name}`, but all spawners name `/{other}`"
            return
    others = sorted(started)
    for node, word, name in {name: (node, word, name) for node, word, name in reversed(missed)}.values():
        source, near = source_of(node, model), others[0] if len(others) == 1 else nearest(name, others, cutoff=0.6)
        is_written = any(each.text.partition("=")[0] in _OPTIONS for each in node.arguments)
        if source is not None and is_written:
            span = span_in(source, word.line, word.column, word.text, ("args",))
        else:
            span = place_of(node, model)
        if span is not None:
            hint = Suggestion(f"/{near}" if near is not None else None, f"/{name}")
            yield span, f"no controller manager is called `/{name}`" + hint


def _managers(tree: LaunchContents) -> dict[str, LaunchNode]:
    """Return the full names of the controller managers that a launch starts, without slashes at their ends."""
    found = {}
    for node in tree.nodes:
        if (node.package, node.program) == (_DEFAULT, "ros2_control_node"):
            is_moved = any("__n" in each.text for each in node.arguments)
            found[UNKNOWN if is_moved else full_name(node, node.name or _DEFAULT)] = node
    return found


def _may_have_others(model: Model) -> bool:
    """Return whether another program can start a controller manager."""
    if any(package not in WITHOUT_MANAGER for tree in launch_trees(model) for package, _ in tree.outside):
        return True
    texts = (each.text for each in (*model.expanded.sources.values(), *model.related_files.values()))
    return any(re.search(_OTHERS, text) for text in texts)


def _of_plugins(model: Model) -> frozenset[str] | None:
    """Return the full names of the controller managers in plugins of Gazebo; None if some of them are unknown."""
    found = set[str]()
    own = [plugin for plugin, _, _ in plugins(model.robot) if _PLUGIN in (plugin.filename or "")]
    for plugin in own:
        ros, name = plugin.element.find("ros"), plugin.element.find("controller_manager_name")
        space = ros.find("namespace") if ros is not None else None
        texts = (space.text if space is not None else "", name.text if name is not None else _DEFAULT)
        if any("$" in text for text in texts):
            return None
        found.add("/".join(text.strip().strip("/") for text in texts).strip("/"))
    described = [each.text for each in model.expanded.sources.values()]
    if not own and any(re.search(rf"<plugin\b[^<>]*{_PLUGIN}", text) for text in described):  # with other arguments
        is_moved = any(re.search(r"<namespace>|<controller_manager_name>", text) for text in described)
        return None if is_moved else frozenset({_DEFAULT})
    return frozenset(found)


def manager_of(node: LaunchNode) -> PlacedText | None:
    """Return the controller manager that a spawner names, or its default; None if it is computed."""
    if node.is_open or not is_constant(node.namespace) or any(_is_moved(word.text) for word in node.arguments):
        return None
    for before, word in zip(("", *(each.text for each in node.arguments)), node.arguments, strict=False):
        if before in _OPTIONS or word.text.startswith("--controller-manager="):
            wanted = PlacedText(word.text.rpartition("=")[2], word.line, word.column)
            return wanted if is_constant(word.text) and wanted.text else None
    is_complete = all(is_constant(word.text) for word in node.arguments)
    return PlacedText(_DEFAULT, node.line, node.column) if is_complete else None


def _is_moved(word: str) -> bool:
    """Return whether an argument of a spawner sets its namespace."""
    return word in ("-n", "--namespace") or "__ns" in word
