"""Nodes of ROS 2 launch files without the parameters that a YAML file of the workspace has for them."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.names import name_of_node
from urdfkit.lint.facts.nodes.node_sections import groups_of
from urdfkit.lint.facts.nodes.simulation_time import without_clock
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Source, tuple[int, int], str]]

_SEVERAL = ("controller_manager", "gazebo_ros", "ros_gz_sim", "moveit_ros_move_group", "nav2_lifecycle_manager")
"""Packages whose nodes get parameters in other ways, or whose processes contain further nodes."""

_FOR_ALL = ("SetParametersFromFile", "set_parameters_from_file")


def nodes_without_section(model: Model) -> Defects:
    """Yield the nodes that load no file with a section of their name, although other nodes load such a file.

    Also yields the parameter file of a node that is that of other nodes.

    Nodes that also start with this section, and sections in several files, have a reason to differ. Nodes without the
    clock of the others are reported by simulation-time-inconsistent.
    """
    nodes, files = launched_nodes(model), parameter_files(model)
    if any(word in node.source.text for node in nodes for word in _FOR_ALL):
        return
    own: dict[str, list[Source]] = {}
    for source in files.values():
        for key, _ in sections(source) if PARAMETERS in source.text else ():
            own.setdefault(key.last_name, []).append(source)
    found = list(_files_of_other_nodes(nodes, files, own))
    yield from ((node.source, node.file_places[0], message) for node, message in found)
    by_name: dict[str, list[LaunchedNode]] = {}
    for node in (each for each in nodes if not any(each is other for other, _ in found)):
        by_name.setdefault(name_of_node(node) or node.program, []).append(node)
    for name, named in by_name.items():
        sources = own.get(name, [])
        if len(sources) != 1 or any(any(True for _ in groups_of(node, files)) for node in named):
            continue
        if any(node.inline is None or any(file not in files for file in node.files) for node in named):
            continue
        if not any(files[file] is sources[0] for node in nodes for file in node.files if file in files):
            continue
        without = {(source.file, start) for source, (start, _), _ in without_clock(model)}
        for node in named:
            starts = [each[0] for each in (node.place, (node.name.start, 0) if node.name is not None else None) if each]
            if any((node.source.file, start) in without for start in starts):
                continue
            if node.package not in _SEVERAL and node.place is not None and not node.namespace:
                short = sources[0].file.rpartition("/")[2]
                yield node.source, node.place, f"node `{name}` does not load {short}, which has its parameters"


def _files_of_other_nodes(
    nodes: list[LaunchedNode], files: dict[tuple[str, str], Source], own: dict[str, list[Source]]
) -> Iterator[tuple[LaunchedNode, str]]:
    """Yield the nodes whose only parameter file has sections of other nodes and not theirs, with the message.

    Another file of the same package then has the only section for the node, and no launch file loads it for the node.
    """
    paths = {source.file: file for file, source in files.items()}
    loaded: dict[str, set[str]] = {}
    for node in nodes:
        loaded.setdefault(name_of_node(node), set()).update(files[file].file for file in node.files if file in files)
    for node in nodes:
        name, sources = name_of_node(node), own.get(name_of_node(node), [])
        if len(node.files) != 1 or node.files[0] not in files or len(sources) != 1 or node.package in _SEVERAL:
            continue
        file, right = files[node.files[0]], sources[0]
        names = [key.last_name for key, _ in sections(file)]
        is_other = bool(names) and not any(each == name or "*" in each for each in names)
        if is_other and paths[right.file][0] == node.files[0][0] and right.file not in loaded[name]:
            short, meant = (each.file.rpartition("/")[2] for each in (file, right))
            yield node, f"{short} has no section `{name}`; {meant} has it"


def maps_without_file(model: Model) -> Defects:
    """Yield the map servers of Nav2 without a file of the map: neither inline nor in their parameter files."""
    files = parameter_files(model)
    for node in launched_nodes(model):
        if (node.package, node.program) != ("nav2_map_server", "map_server") or node.inline is None or not node.files:
            continue
        values = [group.find("yaml_filename") for _, group in groups_of(node, files)]
        is_rewritten = "param_rewrites" in node.source.text and "yaml_filename" in node.source.text
        is_set = (
            is_rewritten or "yaml_filename" in node.inline or any(value is not None and value.text for value in values)
        )
        is_read = all(file in files for file in node.files) and values
        if node.place is not None and is_read and not is_set:
            yield node.source, node.place, "`map_server` needs the parameter `yaml_filename`"
