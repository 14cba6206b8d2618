"""Sections of parameters that no controller reads, and the names of parts of the robot that they contain."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.controller_settings import settings
from urdfkit.lint.facts.control.yaml_tree import Node, nodes, walk, yamls
from urdfkit.lint.facts.parameters.odd_files import files_of_nodes
from urdfkit.lint.model.model import Model


def groups_of_nodes(model: Model) -> Iterator[tuple[Source, Node]]:
    """Yield the mappings in the parameters of nodes with their files, without those of controllers."""
    read = {id(node) for source in yamls(model) for one in settings(source) for node in walk(one.group)}
    for source in files_of_nodes(model):
        for group in nodes(source):
            if group.entries and id(group) not in read:
                yield source, group


@lru_cache(maxsize=4096)
def tokens(name: str) -> tuple[str, ...]:
    """Return the lower-case words of a name."""
    return tuple(re.findall(r"[a-z]+|\d+", re.sub(r"(?<=[a-z])(?=[A-Z])", "_", name).lower()))
