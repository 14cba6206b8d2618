"""Packages without a robot, such as bringup: their launch, YAML and build files are checked."""

from __future__ import annotations

from pathlib import Path

from urdfkit.description.packages.resolver import Packages
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Origin, Position
from urdfkit.lint.model.model import Model
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.target_platform import family_of, release_of
from urdfkit.lint.rules import related_file_rules, robot_rules

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

_FAMILIES = "KLM"
"""First letters of the codes of rules on packages, launch files and MoveIt."""


def empty_root(path: Path) -> Element:
    """Return the root element that stands for a robot that is unreadable or does not exist."""
    return Element("robot", {}, [], "", Origin(Position(str(path), 1, 1)))


def package_model(path: Path, options: Options, packages: Packages) -> Model:
    """Return the model of a package without a robot.

    Args:
        path: package.xml of the package.
        options: lint options.
        packages: package resolver.
    """
    from urdfkit.description.urdf.parser import parse
    from urdfkit.description.xacro.expanded import Expanded

    expanded = Expanded(path, None, (path.absolute(),), {}, packages)
    target = options.target
    return Model(expanded, parse(empty_root(path)), family_of(target), None, release_of(target), options.texts)


def package_rules(model: Model) -> list[type[Any]]:
    """Return the rules that check the files of a package without its robot."""
    rules = (*robot_rules(model.robot, model.target), *related_file_rules(model.related_files))
    return [rule for rule in rules if rule.code[0] in _FAMILIES]
