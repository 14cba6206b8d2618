"""Sections of ROS 2 parameter files that are in another namespace than their node.

Source: rcl (rcl_yaml_param_parser/src/parse.c) and rclcpp (parameter_map.cpp): a section is for the node with this full
name; ``*`` stands for one part of the name and ``**`` for any number of parts.
"""

import re
from collections import Counter
from collections.abc import Iterator

from urdfkit.description.launch.launch_scope import LaunchContents, LaunchNode
from urdfkit.description.xml.reader import shown_path
from urdfkit.description.xml.source import Source, Span
from urdfkit.lint.facts.connections.trees import full_name, is_constant, launch_trees, place_of
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS, declared
from urdfkit.lint.facts.control.yaml_tree import Node, documents, span_of
from urdfkit.lint.facts.nodes.names import default_name
from urdfkit.lint.model.model import Model

_MANAGER = "controller_manager"
_MAX_DEPTH = 4


def sections_elsewhere(model: Model) -> Iterator[tuple[Span, str]]:
    """Yield place and message of each node whose only sections are in another namespace."""
    readers = [each for tree in launch_trees(model) for each in _readers(tree, model)]
    used = {id(key) for _, _, name, file, root in readers for key, path in _sections(file, root) if _is_for(path, name)}
    seen, missed = set[tuple[str, int]](), set[int]()
    for tree, node, name, source, root in readers:
        sections = _sections(source, root)
        own = [(key, path) for key, path in sections if path.rpartition("/")[2] == name.rpartition("/")[2]]
        is_read = any(_is_for(path, name) for _, path in sections) or any(id(key) in used for key, _ in own)
        if not own or is_read or id(node) in missed:
            continue
        missed.add(id(node))
        (key, path), spaces = own[0], Counter(each.namespace for each in tree.nodes)
        is_rare = node.namespace != "" and 2 * spaces[node.namespace] <= len(tree.nodes)
        span = place_of(node, model) if is_rare else span_of(source, key)
        if span is not None and (span.file, span.line) not in seen:
            seen.add((span.file, span.line))
            yield span, f"node `/{name}` has no section in {source.file.rpartition('/')[2]}; it has a section `/{path}`"


def _readers(tree: LaunchContents, model: Model) -> Iterator[tuple[LaunchContents, LaunchNode, str, Source, str]]:
    """Yield each node with its full name, a parameter file, and the namespace that the launch file adds to it.

    Controllers are nodes in the namespace of their controller manager.
    """
    for node in tree.nodes:
        is_manager = (node.package, node.program) == (_MANAGER, "ros2_control_node")
        base = node.name or (_MANAGER if is_manager else default_name(node.package, node.program))
        is_renamed = any(re.search(r"__n\w+:=", word.text) for word in node.arguments)
        if not base or is_renamed or not is_constant(f"{base}{node.namespace}"):
            continue
        for file, root in node.files:
            source = model.related_files.get(shown_path(file))
            if source is None or PARAMETERS not in source.text or not is_constant(root):
                continue
            yield tree, node, full_name(node, base), source, root
            if is_manager:
                names = [one.name for one in declared(source) if one.settings is not None]
                yield from ((tree, node, full_name(node, name), source, root) for name in names)


def _sections(source: Source, root: str) -> list[tuple[Node, str]]:
    """Return the key and the full name of each section, without slashes at its ends."""
    found: list[tuple[Node, str]] = []
    waiting = [(key, value, root) for document in documents(source) for key, value in document.entries]
    while waiting:
        key, value, above = waiting.pop(0)
        path = f"{above}/{key.text.strip('/')}".strip("/")
        if value.find(PARAMETERS) is not None:
            found.append((key, path))
        elif path.count("/") < _MAX_DEPTH:
            waiting += [(inner, each, path) for inner, each in value.entries]
    return found


def _is_for(section: str, node: str) -> bool:
    """Return whether the parameters of a section are those of a node."""
    parts = [re.escape(part) for part in section.split("/")]
    pattern = "/".join(parts).replace(r"\*\*/", "(?:.*/)?").replace(r"\*\*", ".*").replace(r"\*", "[^/]*")
    return re.fullmatch(pattern, node) is not None
