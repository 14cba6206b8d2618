"""The option ``--no-launch-arguments``: xacro arguments from the launch files of the robot's package."""

from __future__ import annotations

import argparse
import sys
from dataclasses import replace

from urdfkit.resources import ModelArgument, robots_dir

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.launch.launch_arguments import Choice


def add_launch_arguments(parser: argparse.ArgumentParser, purpose: str) -> None:
    """Add the option.

    Args:
        parser: parser of the command.
        purpose: ``simulation`` or ``display``: the launch files whose arguments are used.
    """
    parser.add_argument(
        "--no-launch-arguments",
        dest="launch_arguments",
        action="store_const",
        const=None,
        default=purpose,
        help=f"do not use the xacro arguments that the {purpose} launch file of the robot's package passes",
    )


def with_launch_arguments(model: ModelArgument, arguments: argparse.Namespace) -> ModelArgument:
    """Return a robot with the arguments of its launch files, which those of the command line override; print them.

    Args:
        model: the robot and the arguments of the command line.
        arguments: with the option of `add_launch_arguments`.
    """
    from urdfkit.description.launch.launch_arguments import choose, passed_to
    from urdfkit.description.packages.resolver import Packages
    from urdfkit.description.xacro.expand import is_xacro

    purpose = arguments.launch_arguments
    if purpose is None or model.macro is not None or not is_xacro(model.path) or robots_dir() in model.path.parents:
        return model
    choice = choose(passed_to(model.path, Packages(model.package_path, model.path)), purpose, model.arguments)
    if not arguments.quiet:
        _report(choice, purpose, model)
    taken = {name: value for passed in choice.chosen.values() for name, value in passed.items()}
    return replace(model, arguments={**taken, **model.arguments})


def _report(choice: Choice, purpose: str, model: ModelArgument) -> None:
    from urdfkit.description.xml.reader import shown_path

    for launch, passed in choice.chosen.items():
        words = " ".join(f"{name}:={value}" for name, value in passed.items())
        message = f"urdfkit: xacro arguments of {shown_path(launch)}: {words} (--no-launch-arguments ignores them)"
        print(message, file=sys.stderr)
    if choice.conflicts:
        values = [
            " and ".join(f"{name}:={value} ({shown_path(launch)})" for value, launch in by_value.items())
            for name, by_value in choice.conflicts.items()
        ]
        one = " ".join(f"{name}:={next(iter(by_value))}" for name, by_value in choice.conflicts.items())
        message = f"urdfkit: warning: the {purpose} launch files pass different xacro arguments to "
        message += f"{shown_path(model.path)}, and none is used: {'; '.join(values)}; choose one, such as {one}"
        print(message, file=sys.stderr)
