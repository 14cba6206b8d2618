"""The arguments ``ROBOT TIP`` and ``--base LINK`` of commands on a kinematic chain."""

import argparse
import sys

from urdfkit.cli.robot_arguments.robot_loading import add_robot_options, load_with_notes, named_robot
from urdfkit.description import Robot
from urdfkit.errors import UsageError
from urdfkit.resources import ModelArgument


def add_tip(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "words",
        nargs="*",
        metavar="ROBOT TIP",
        help="a .urdf or .xacro file, a package folder or a robot name, then key:=value xacro arguments, then the link "
        "at the tip of the chain",
    )
    parser.add_argument("--base", metavar="LINK", help="the link that poses are expressed in (default: the root link)")
    add_robot_options(parser)


def announce(message: str) -> None:
    """Print a message on standard error, such as the one before the kernel is compiled."""
    print(message, file=sys.stderr, flush=True)


def model_of_tip(arguments: argparse.Namespace) -> ModelArgument:
    """Return the robot of the words of `add_tip`, not loaded."""
    plain = [word for word in arguments.words if ":=" not in word]
    xacro_words = [word for word in arguments.words if ":=" in word]
    return named_robot([plain[0], *xacro_words], arguments)


def robot_and_tip(arguments: argparse.Namespace, command: str) -> tuple[Robot, str]:
    """Load the robot and return it with the name of the tip.

    Args:
        arguments: with those of `add_tip`.
        command: name of the command, for messages.

    Raises:
        UsageError: the robot or the tip is missing.
        UrdfkitError: the robot cannot be loaded.
    """
    from urdfkit.description.xml.cost_limit import loading_limit

    plain = [word for word in arguments.words if ":=" not in word]
    if not plain or len(plain) > 2:
        raise UsageError(f"{command}: expected ROBOT and TIP, got {len(plain)} words: {' '.join(plain) or 'none'}")
    with loading_limit():
        robot = load_with_notes(model_of_tip(arguments), arguments)
    if len(plain) == 1:
        ends = [link.name for link in robot.links if not robot.children_of.get(link.name)]
        some = ", ".join([*ends[:6], *("…" for _ in ends[6:7])])
        raise UsageError(f"{command}: add the link at the tip of the chain after `{plain[0]}`, such as {some}")
    return robot, plain[1]
