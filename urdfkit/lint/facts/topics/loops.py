"""Nodes that read the topic on which they publish, and nodes that publish on the same topic."""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_joints import Named
from urdfkit.lint.facts.control.yaml_tree import Node, start_of
from urdfkit.lint.facts.nodes.node_sections import groups_of
from urdfkit.lint.facts.nodes.started import LaunchedNode, launched_nodes, parameter_files
from urdfkit.lint.facts.topics.graph import remapped
from urdfkit.lint.facts.topics.node_topics import NodeTopics, topics_of
from urdfkit.lint.model.model import Model

Defects = Iterator[tuple[Source, Named, str]]

_INPUT = r"(?:odom|imu|twist|pose)\d+"


def self_readers(model: Model) -> Defects:
    """Yield the file, the topic and the message of each remapping or parameter that closes a loop."""
    files = parameter_files(model)
    for node in launched_nodes(model):
        topics = topics_of(node.package, node.program)
        if topics is None:
            continue
        pairs = [
            (read, written)
            for read in topics.read
            for written in topics.published
            if remapped(node, read) == remapped(node, written)
        ]
        for old, new in node.remappings if pairs else ():
            if old.name.removeprefix("~").strip("/") in pairs[0] and not re.search(r"\$|[{}]", new.name):
                message = f"`{node.program}` publishes on `{new.name}` and subscribes to it, so it reads its own output"
                yield node.source, new, message
                break
        yield from _of_parameters(node, topics, files)


def _of_parameters(node: LaunchedNode, topics: NodeTopics, files: dict[tuple[str, str], Source]) -> Defects:
    """Yield the inputs of a filter of robot_localization that are its own output."""
    outputs = {remapped(node, topic) for topic in topics.published} if node.package == "robot_localization" else set()
    for source, group in groups_of(node, files) if outputs else ():
        for key, value in group.entries:
            if re.fullmatch(_INPUT, key.text) and value.text.strip("/") in outputs:
                message = f"`{node.program}` publishes `{value.text}`, so `{key.text}` makes it read its own output"
                yield source, _named(source, value), message


def _named(source: Source, value: Node) -> Named:
    return Named(value.text, start_of(source, value))


def published_together(model: Model) -> Iterator[tuple[LaunchedNode, str, str]]:
    """Yield each node that publishes on the topic of another node of its launch file, the message and the type."""
    seen: dict[tuple[str, str], LaunchedNode] = {}
    for node in launched_nodes(model):
        topics = topics_of(node.package, node.program)
        is_resolved = topics is not None and node.namespace is not None and not node.has_more_remappings
        for topic, type in topics.published.items() if topics is not None and is_resolved else ():
            used = f"{node.namespace}/{remapped(node, topic)}".strip("/")
            is_computed = re.search(r"[${}]", used) is not None
            is_computed |= _is_swapped(node, topic)
            first = seen.setdefault((node.source.file, used), node) if not is_computed else node
            is_other = first is not node and (first.package, first.program) == (node.package, node.program)
            if is_other and node.place is not None and not (first.is_conditional and node.is_conditional):
                message = f"two nodes of this file publish {type} messages on `{used}`; remap `{topic}` of one of them"
                yield node, message, type
                break


def swapped_types(model: Model) -> Iterator[str]:
    """Yield the types of messages on topics that are the new name of a remapping of their own node."""
    for node in launched_nodes(model):
        topics = topics_of(node.package, node.program)
        for topic, type in topics.published.items() if topics is not None else ():
            if _is_swapped(node, topic):
                yield type


def _is_swapped(node: LaunchedNode, topic: str) -> bool:
    return any(new.name.strip("/") == topic != old.name.strip("/") for old, new in node.remappings)
