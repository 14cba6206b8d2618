"""The option `--strict`, and loading of the robot of a command: repaired by default, rejected with `--strict`."""

from __future__ import annotations

import argparse
import sys

from urdfkit.cli.robot_arguments.file_name_case import warn_of_file_names
from urdfkit.cli.robot_arguments.required_arguments import listing_required_arguments

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any

    from urdfkit.description import Robot
    from urdfkit.description.urdf.repair_record import Repair
    from urdfkit.resources import ModelArgument


def add_strict(parser: argparse.ArgumentParser, example: str) -> None:
    """Add the option.

    Args:
        parser: parser of the command.
        example: a repair of the command.
    """
    parser.add_argument(
        "--strict",
        action="store_true",
        help=f"reject robots that are repaired with a warning by default, such as robots with {example}",
    )


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


def print_repairs(robot: Robot, *, quiet: bool) -> None:
    """Print the repairs and the files with other capital letters on standard error; see `grouped`.

    Args:
        robot: the robot.
        quiet: print warnings only.
    """
    from urdfkit.description.urdf.repair_record import grouped

    warn_of_file_names(robot, quiet=quiet)
    for repair in grouped(shown_repairs(robot.repairs, quiet=quiet)):
        print(f"urdfkit: {repair.severity}: {repair}", file=sys.stderr)


def repairs_as_json(robot: Robot) -> dict[str, Any]:
    """Return the key ``repairs`` of a command's JSON value."""
    return {"repairs": [repair.as_json() for repair in robot.repairs]}


def shown_repairs(repairs: Iterable[Repair], *, quiet: bool) -> list[Repair]:
    """Return the repairs to print: all, or with ``--quiet`` the warnings."""
    return [repair for repair in repairs if not quiet or repair.severity == "warning"]
