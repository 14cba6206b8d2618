"""YAML files that nodes read, and names in the code of nodes."""

import re
from collections.abc import Iterator
from pathlib import Path

from urdfkit.description.packages.related_files import LAUNCH, neighbours
from urdfkit.description.xml.source import Source
from urdfkit.lint.facts.control.ros2_controllers import PARAMETERS
from urdfkit.lint.facts.control.yaml_tree import yamls
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.code_files import node_texts

_FOLDERS = ("config", "configs", "cfg", "param", "params", "parameters", "yaml")
"""Folders of parameters in packages."""


def files_of_nodes(model: Model) -> Iterator[Source]:
    """Yield the YAML files with parameters, in folders of parameters, or that launch files name."""
    launch_files = [source.text for name, source in model.related_files.items() if name.endswith(LAUNCH)]
    for source in yamls(model):
        path = Path(source.file).absolute()
        if path.name.startswith("."):
            continue
        is_named = PARAMETERS in source.text or not set(path.parent.parts[-3:]).isdisjoint(_FOLDERS)
        if is_named or any(re.search(rf"(?<![\w.-]){re.escape(path.name)}", text) for text in launch_files):
            yield source


def is_in_code(name: str, model: Model) -> bool:
    """Return whether a name occurs in quotes in the code of a node of the workspace."""
    if model.package is None:
        return False
    for folder in neighbours(model.package).values():
        model.expanded.packages.watch(folder)
        if any(f'"{name}"' in text or f"'{name}'" in text for _, text in node_texts(folder)):
            return True
    return False
