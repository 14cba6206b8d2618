"""Names of nodes that differ between launch files, parameter files and lifecycle managers."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.launch.python_constants import launch_reader, parsed
from urdfkit.description.packages.related_files import CODE, LAUNCH, neighbours
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.facts.control.yaml_tree import span_of, syntax_error
from urdfkit.lint.facts.launch.actions import all_elements
from urdfkit.lint.facts.launch.executables import released
from urdfkit.lint.facts.launch.node_parameters import parameters_of
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.navigation.tables import NODES
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.facts.ros_packages import is_slip
from urdfkit.lint.facts.topics.node_topics import topics_of
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import code_texts

Defects = Iterator[tuple[Source, Span, str]]

_DEFAULTS = {
    ("joy", "joy_node"): "joy_node",
    ("nav2_amcl", "amcl"): "amcl",
    ("robot_localization", "ekf_node"): "ekf_filter_node",
    ("robot_localization", "ukf_node"): "ukf_filter_node",
    ("robot_localization", "navsat_transform_node"): "navsat_transform",
    ("slam_toolbox", "async_slam_toolbox_node"): "slam_toolbox",
    ("slam_toolbox", "localization_slam_toolbox_node"): "slam_toolbox",
    ("slam_toolbox", "sync_slam_toolbox_node"): "slam_toolbox",
    ("teleop_twist_joy", "teleop_node"): "teleop_twist_joy_node",
    ("twist_mux", "twist_mux"): "twist_mux",
}
"""Package and executable → the name that the node has by default (Humble to Rolling)."""

_RELEASED_NAMES = NODES | {*_DEFAULTS.values()}

_RENAMED = {"recoveries_server": "behavior_server"}
"""Former name of a Nav2 server → its name (migration guide of Nav2, Galactic to Humble)."""

_UNMANAGED = ("map_saver_server", "lifecycle_manager", "costmap_filter_info_server")
"""Nav2 programs that often start without a lifecycle manager of their own file."""

_COMPUTED = (
    r"\.(?:append|extend|insert)\(|\+=|OpaqueFunction|ComposableNode|composable_node|nav2_bringup[\"'/)]"
    r"|<param\b(?=[^>]*\bnode_names\b)[^>]*\$"
)
"""Matches a launch file whose lists of nodes may be longer than they are written."""

_SEVERAL = ("controller_manager", "moveit_ros_move_group", "moveit_servo", "gazebo_ros", "ros_gz_sim", "rviz2")
"""Packages whose processes contain nodes of further names."""


def misnamed(model: Model) -> Defects:
    """Yield the names of nodes that no section of their parameter file has, and the misspelt sections."""
    nodes = launched_nodes(model)
    files = parameter_files(model)
    users: dict[str, list[LaunchedNode]] = {}
    for node in nodes:
        for path in dict.fromkeys(node.files):
            if path in files:
                users.setdefault(files[path].file, []).append(node)
    started = {name_of_node(node) for node in nodes}
    by_file = {source.file: source for source in files.values()}
    reported = set[str]()
    for file, readers in users.items():
        keys = [(key, key.last_name) for key, _ in sections(by_file[file])]
        if not keys or any("*" in key.text for key, _ in keys):
            continue
        seen = set[tuple[int, int]]()
        for node in readers:
            name = name_of_node(node)
            if not name or any(name == other for _, other in keys):
                continue
            near = next((entry for entry in keys if is_slip(entry[1], name) and entry[1] not in started), None)
            is_named = node.name is not None and node.name.name == name
            if near is not None and (
                not is_named or name in _RELEASED_NAMES or name == node.program or near[1] not in _RELEASED_NAMES
            ):
                if not any(is_slip(near[1], each) for each in NODES) and (near[0].line, near[0].column) not in seen:
                    seen.add((near[0].line, near[0].column))
                    message = f"no node is called `{near[1]}`" + Suggestion(name, near[1])
                    yield by_file[file], span_of(by_file[file], near[0]), message
            elif near is not None and node.name is not None:
                message = f"node `{name}` has no section in {_short(file)}" + Suggestion(near[1], name)
                yield node.source, _span(node), message
            elif node.name is not None and len(keys) == len(readers) == 1 and _has_one_node(node, keys[0][1], model):
                if keys[0][1] not in started and (name in _RELEASED_NAMES or node.package not in released()):
                    message = f"no node is called `{keys[0][1]}`" + Suggestion(name, keys[0][1])
                    yield by_file[file], span_of(by_file[file], keys[0][0]), message
                elif keys[0][1] not in started:
                    message = f"node `{name}` has no section in {_short(file)}, whose only section is `{keys[0][1]}`"
                    yield node.source, _span(node), message
            elif node.name is not None and _default(node) in {other for _, other in keys} - started:
                reported |= {name, _default(node)}
                message = f"node `{name}` has no section in {_short(file)}, which has `{_default(node)}`"
                yield node.source, _span(node), message
            elif (node.name is not None or not node.has_name) and (
                unused := _unused(node, by_file[file], readers, started, model)
            ):
                message = f"node `{name}` has no section in {_short(file)}, and no node is named `{unused}`"
                key = next(each for each, other in keys if other == unused)
                # A node that has the name by default, or the name of its program, is not the misnamed side.
                is_default = name in _RELEASED_NAMES or name in (node.program, _default(node))
                if node.name is None or (is_default and unused not in _RELEASED_NAMES):
                    yield by_file[file], span_of(by_file[file], key), message
                else:
                    yield node.source, _span(node), message
    yield from _unmanaged(model, nodes, {each for each in started if each}, reported)


def _unused(node: LaunchedNode, file: Source, readers: list[LaunchedNode], started: set[str], model: Model) -> str:
    """Return the only section without a node whose parameters the node has, if no other node lacks it; else empty."""
    accepted = parameters_of(_default(node)) or _quoted(node, model)
    found = []
    for section, group in sections(file):
        name = section.last_name
        written = [key.text.partition(".")[0] for key, _ in group.entries if not re.search(r"\d", key.text)]
        if name not in started and written and 2 * sum(each in accepted for each in written) >= len(written):
            found.append(name)
    named = {key.last_name for key, _ in sections(file)}
    alike = [each for each in readers if each.program == node.program and name_of_node(each) not in named]
    return found[0] if len(found) == len(alike) == 1 else ""


def _quoted(node: LaunchedNode, model: Model) -> frozenset[str]:
    """Return the texts in the file of a node of the workspace, which contain the names of its parameters."""
    folder = neighbours(model.package).get(node.package) if model.package is not None else None
    if folder is None or not node.program:
        return frozenset()
    model.expanded.packages.watch(folder)
    stem = node.program.removesuffix(".py")
    texts = [text for path, text in code_texts(folder, CODE, LAUNCH) if path.stem == stem]
    return frozenset(re.findall(r"[\"']([\w.]+)[\"']", texts[0])) if len(texts) == 1 else frozenset()


def name_of_node(node: LaunchedNode) -> str:
    """Return the name of a node, or the default name of its program; empty if unknown."""
    if node.name is not None:
        return node.name.name
    return "" if node.has_name else _DEFAULTS.get((node.package, node.program), "")


def default_name(package: str, program: str) -> str:
    """Return the name that a released node has by default; empty if unknown."""
    is_navigation = program in NODES and package.startswith("nav2_")
    return program if is_navigation else _DEFAULTS.get((package, program), "")


def _default(node: LaunchedNode) -> str:
    return default_name(node.package, node.program)


def _span(node: LaunchedNode) -> Span:
    assert node.name is not None
    return node.source.span(node.name.start, node.name.end)


def _short(file: str) -> str:
    return file.rpartition("/")[2]


def _has_one_node(node: LaunchedNode, other: str, model: Model) -> bool:
    """Return whether the process of a node has no node of another name, which the code of a package would quote."""
    folder = neighbours(model.package).get(node.package) if model.package is not None else None
    if folder is None:
        return (
            node.package in released() or topics_of(node.package, node.program) is not None
        ) and node.package not in _SEVERAL
    model.expanded.packages.watch(folder)
    texts = [text for _, text in code_texts(folder, CODE, LAUNCH)]
    pattern = rf"[\"'/]{re.escape(other)}[\"']"
    return any(re.search(r"\brclpy\b|\brclcpp\b", text) for text in texts) and not any(
        re.search(pattern, text) for text in texts
    )


def _listed(source: Source) -> Iterator[tuple[str, Span]]:
    """Yield the names in ``node_names`` of the lifecycle managers of a file, with their places."""
    tree = parsed(source) if source.file.endswith(".py") else None
    if source.file.endswith((".yaml", ".yml")):
        for _, group in (each for each in sections(source) if syntax_error(source) is None):
            names_node = group.find("node_names")
            yield from ((item.text, span_of(source, item)) for item in (names_node.items if names_node else ()))
    for element in all_elements(source) if source.file.endswith(LAUNCH) and tree is None else ():
        parts = element.attributes
        if element.tag == "param" and "value" in parts and "name" in parts and parts["name"].name == "node_names":
            text, start = parts["value"].name, parts["value"].start
            for word in re.finditer(r"[\w/]+", text) if "$" not in text else ():
                yield word[0], source.span(start + word.start(), start + word.end())
    reader = launch_reader(tree) if tree is not None else None
    for node in (each for each in ast.walk(tree) if isinstance(each, ast.Dict)) if tree is not None else ():
        for key, value in zip(node.keys, node.values, strict=True):
            if reader is None or key is None or reader.text(key) != "node_names":
                continue
            names = reader.assigned.get(value.id) if isinstance(value, ast.Name) else value
            for item in names.elts if isinstance(names, (ast.List, ast.Tuple)) else ():
                if isinstance(item, ast.Constant) and isinstance(item.value, str):
                    yield item.value, source.span(*place(source, item))


def _unmanaged(model: Model, nodes: list[LaunchedNode], started: set[str], reported: set[str]) -> Defects:
    """Yield the misspelt names in ``node_names`` of a lifecycle manager, in launch files and YAML.

    `reported` are the wrong names of nodes that are reported already, and the names that these nodes should have.
    """
    managers = [source for source in model.related_files.values() if "node_names" in source.text]
    lists = {source.file: list(_listed(source)) for source in managers}
    for source in managers:
        listed = lists[source.file]
        names_listed = {name for name, _ in listed}
        order = [node.program if not node.has_name else name_of_node(node) for node in nodes if node.source is source]
        own = {*order}
        others = [other for other in managers if other is not source]
        elsewhere = {name for other in others for name, _ in lists[other.file]}
        is_whole = not any(_lists_more(other) for other in others)
        unlisted = list(_unlisted(source, names_listed, elsewhere, nodes)) if is_whole else []
        unknown: list[tuple[str, Span]] = []
        manages_slam = re.search(r"use_lifecycle_manager|LifecycleNode|lifecycle_node", source.text) is not None
        for name, span in listed:
            if name == "slam_toolbox" and not manages_slam:
                message = "`slam_toolbox` activates itself, unless `use_lifecycle_manager` is true; remove it here"
                yield source, span, message
                continue
            near = next((each for each in sorted(started - names_listed) if _is_meant(each, name)), None)
            if name not in started | _RELEASED_NAMES and near is not None:
                yield source, span, f"no node is called `{name}`" + Suggestion(near, name)
            elif (
                near is None
                and name in NODES - own - started - reported
                and len(names_listed & own) > 1
                and not _lists_more(source)
                and re.search(r"IncludeLaunchDescription|<include\b|- include:", source.text) is None
            ):
                unknown.append((name, span))
        missing = [(name, span) for name, span in listed if name in NODES - own - started - reported]
        replaced = {name: unlisted[0][0] for name, _ in missing} if len(missing) == len(unlisted) == 1 else {}
        meant = {_RENAMED.get(name) for name, _ in unknown} | set(replaced.values())
        for name, span in missing if replaced else unknown:
            hint = Suggestion(replaced.get(name) or _RENAMED.get(name), name)
            yield source, span, f"no launch file of these packages starts the node `{name}`" + hint
        for name, span in unlisted:
            if name in meant | reported:
                continue
            message = f"no lifecycle manager of this file lists the node `{name}`, so it is never activated"
            # The file starts the node after the one with this name, so its name belongs after this name.
            before = order[: order.index(name)]
            places = [at for each, at in listed if each in before] or [at for each, at in listed if each in own]
            yield source, places[-1] if places else span, message


def _unlisted(
    source: Source, listed: set[str], elsewhere: set[str], nodes: list[LaunchedNode]
) -> Iterator[tuple[str, Span]]:
    """Yield the Nav2 servers that no list of their launch file names, although another server is listed."""
    own = [node for node in nodes if node.source is source]
    servers = [(node, node.program if not node.has_name else name_of_node(node)) for node in own if _is_server(node)]
    if not any(name in listed for _, name in servers) or _lists_more(source):
        return
    for node, name in servers:
        is_misspelt = any(_is_meant(name, other) for other in listed)
        if name and name not in listed | elsewhere and not is_misspelt and node.place is not None:
            yield name, source.span(*node.place)


def _is_server(node: LaunchedNode) -> bool:
    return node.package.startswith("nav2_") and node.program in NODES and node.program not in _UNMANAGED


def _lists_more(source: Source) -> bool:
    """Return whether a launch file may list more nodes than its constant lists do."""
    return re.search(_COMPUTED, source.text) is not None


def _is_meant(node: str, name: str) -> bool:
    """Return whether a name in a list means a node: it is misspelt, or it has a word more than a released node."""
    return is_slip(name, node) or (node in _RELEASED_NAMES and name.startswith(f"{node}_"))
