"""Loading of the robot of a command: its options, its repairs, and the warnings about its arguments and files."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace

from urdfkit.cli.parser import add_package_path
from urdfkit.cli.robot_arguments.required_arguments import listing_required_arguments

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path
    from typing import Any

    from urdfkit.description import Robot
    from urdfkit.description.urdf.repair_record import Repair
    from urdfkit.resources import ModelArgument


def add_macro(parser: argparse.ArgumentParser) -> None:
    """Add ``--macro``: instantiate a macro of a file that defines macros only."""
    parser.add_argument(
        "--macro",
        metavar="NAME",
        help="instantiate this macro of the file; key:=value arguments also set its parameters",
    )


def add_strict(parser: argparse.ArgumentParser, example: str = "a second root link") -> None:
    """Add ``--strict``: reject robots that are repaired by default.

    Args:
        parser: parser of the command.
        example: a repair of the command.
    """
    parser.add_argument(
        "--strict",
        action="store_true",
        help=f"reject defective robots, such as robots with {example}, instead of repairing them with a warning",
    )


def add_robot_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of a command whose words begin with a robot: ``--macro``, ``--strict``, ``--package-path``."""
    add_macro(parser)
    add_strict(parser)
    add_package_path(parser)


def named_robot(words: list[str], arguments: argparse.Namespace) -> ModelArgument:
    """Return the robot of the words ``ROBOT key:=value …``, not loaded.

    Args:
        words: the words.
        arguments: values of ``--package-path`` and ``--macro``.

    Raises:
        UrdfkitError: the words name no robot.
    """
    from urdfkit.resources import find_model

    return replace(find_model(words, package_path=arguments.package_path), macro=arguments.macro)


def load_robot(model: ModelArgument, arguments: argparse.Namespace) -> Robot:
    """Load a robot, with the repairs of its structure unless ``--strict`` is set.

    Args:
        model: the robot.
        arguments: values of ``--strict`` and ``--quiet``.

    Raises:
        UrdfkitError: the file has no robot, or the robot needs a repair and ``--strict`` is set.
    """
    from urdfkit.description.loading import load_repaired, load_valid
    from urdfkit.kinematics.mimic import without_impossible_mimics

    with listing_required_arguments(model, quiet=arguments.quiet):
        robot = (load_valid if arguments.strict else load_repaired)(model)
    return robot if arguments.strict else without_impossible_mimics(robot)


def load_with_notes(model: ModelArgument, arguments: argparse.Namespace) -> Robot:
    """Load a robot; print its unused arguments, its repairs and its files with other capital letters.

    Args:
        model: the robot.
        arguments: values of ``--strict`` and ``--quiet``.

    Raises:
        UrdfkitError: as for `load_robot`.
    """
    from urdfkit.description.urdf.repair_record import grouped

    robot = load_robot(model, arguments)
    warn_of_unused_arguments(model, robot.files, quiet=arguments.quiet)
    warn_of_file_names(robot, quiet=arguments.quiet)
    for repair in grouped(shown_repairs(robot.repairs, quiet=arguments.quiet)):
        print(f"urdfkit: {repair.severity}: {repair}", file=sys.stderr)
    return robot


def warn_of_unused_arguments(model: ModelArgument, files: Iterable[Path], *, quiet: bool) -> None:
    """Warn of xacro arguments that no file uses; xacro ignores them, and with them misspelt names.

    Args:
        model: the robot of the command line.
        files: the files of the robot.
        quiet: print nothing.
    """
    if quiet or not model.arguments:
        return
    from urdfkit.description.xacro.declared_arguments import unused_arguments
    from urdfkit.description.xml.reader import read_source

    for line in unused_arguments(model.arguments, [read_source(file) for file in files], model.macro):
        print(f"urdfkit: warning: {line}", file=sys.stderr)


def warn_of_file_names(robot: Robot, *, quiet: bool) -> None:
    """Warn of the files of a robot, whose meshes are loaded, that exist only under a name with other capital letters.

    Args:
        robot: the robot.
        quiet: print nothing.
    """
    if robot.packages is not None and not quiet:
        for note in robot.packages.notes.values():
            print(f"urdfkit: warning: {note}", file=sys.stderr)


def repairs_as_json(robot: Robot) -> dict[str, Any]:
    """Return the key ``repairs`` of a command's JSON value."""
    return {"repairs": [repair.as_json() for repair in robot.repairs]}


def shown_repairs(repairs: Iterable[Repair], *, quiet: bool) -> list[Repair]:
    """Return the repairs to print: all, or with ``--quiet`` the warnings."""
    return [repair for repair in repairs if not quiet or repair.severity == "warning"]
