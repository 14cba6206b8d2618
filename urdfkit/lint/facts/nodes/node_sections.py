"""Parameters of launched nodes in YAML files."""

import re
from collections.abc import Iterator

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import Node, documents
from urdfkit.lint.facts.navigation.sections import sections
from urdfkit.lint.facts.nodes.started import LaunchedNode


def groups_of(node: LaunchedNode, files: dict[tuple[str, str], Source]) -> Iterator[tuple[Source, Node]]:
    """Yield the parameters that a node has in its files: its sections of ROS 2, or the whole file of ROS 1.

    Args:
        node: the node.
        files: YAML files by package and path in it.
    """
    for source in (files[file] for file in node.files if file in files):
        if PARAMETERS not in source.text:
            yield from ((source, root) for root in documents(source))
        names = {node.name.name} if node.name is not None else set()
        for key, group in sections(source):
            name = key.last_name
            if name in names or (not node.has_name and re.sub(r"_node$", "", node.program) in name) or "*" in name:
                yield source, group
