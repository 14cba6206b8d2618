"""Parameter files of navigation: the sections of ROS 2 nodes, the costmaps of ROS 1."""

from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents, nodes, walk
from urdfkit.lint.facts.navigation.tables import COSTMAP_ROS1, NODES

COSTMAPS = ("local_costmap", "global_costmap")


def sections(source: Source) -> Iterator[tuple[Node, Node]]:
    """Yield the names of ROS 2 nodes in a YAML file with their parameters; namespaces are passed over."""
    roots = documents(source) if PARAMETERS in source.text else ()
    waiting = [(entry, 0) for root in roots for entry in root.entries]
    while waiting:
        (key, value), depth = waiting.pop(0)
        group = value.find(PARAMETERS)
        if group is not None:
            yield key, group
        elif depth < 3:
            waiting += [(entry, depth + 1) for entry in value.entries]


def costmaps_not_nested(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the sections of costmaps that lack the level of the namespace, with the message.

    Source: nav2_costmap_2d (costmap_2d_ros.cpp), Humble to Rolling: the node and its namespace have the same name.
    """
    for root in documents(source) if PARAMETERS in source.text else ():
        for key, value in root.entries:
            if key.text in COSTMAPS and value.find(PARAMETERS) is not None and not _has_entries(value.find(key.text)):
                yield key, f"the node is `/{key.text}/{key.text}`; write `{key.text}:` twice, one level below the other"


def _has_entries(node: Node | None) -> bool:
    return node is not None and bool(node.entries)


def nodes_without_parameters(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the nodes of Nav2 whose parameters are not below ``ros__parameters``, for which rcl refuses the file."""
    for root in documents(source) if PARAMETERS in source.text else ():
        for key, value in root.entries:
            names = [name.text for node in walk(value) for name, _ in node.entries]
            if key.text in NODES and names and not any(name.startswith("ros_") for name in names):
                yield key, f"node `{key.text}` has no `{PARAMETERS}`; write it above the parameters"


def outside_parameters(source: Source) -> Iterator[tuple[Node, str]]:
    """Yield the keys next to ``ros__parameters`` that are no nodes, for which rcl refuses the file.

    Source: rcl_yaml_param_parser/src/parse.c, "Cannot have a value before ros__parameters".
    """
    for node in nodes(source) if PARAMETERS in source.text else ():
        for key, value in node.entries if node.find(PARAMETERS) is not None else ():
            is_node = any(each.find(PARAMETERS) is not None for each in walk(value))
            if key.text != PARAMETERS and not is_node and (value.entries or value.text or value.items):
                yield key, f"`{key.text}` is next to `{PARAMETERS}`, not below it; indent it"


def costmaps_of_ros1(source: Source) -> Iterator[Node]:
    """Yield the groups of parameters of costmap_2d in a ROS 1 YAML file."""
    if "footprint" not in source.text and "frame" not in source.text:
        return
    for node in (each for each in nodes(source) if each.kind == "group"):
        if len({key.text for key, _ in node.entries} & COSTMAP_ROS1) >= 3:
            yield node
