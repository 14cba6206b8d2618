"""`urdfkit topic`: talk to a running simulation, as ``rostopic`` and ``ros2 topic`` do. One module per kind of work."""

from __future__ import annotations

import argparse
from importlib import import_module

from urdfkit.cli.parser import HelpFormatter

SUBCOMMANDS = {
    "list": ("list_topics", "print the topics there are"),
    "info": ("list_topics", "print type, number of messages and listeners of a topic"),
    "echo": ("echo", "print messages as they come"),
    "hz": ("rates", "print how often messages come, in simulated time"),
    "bw": ("rates", "print how many bytes the messages of a topic take"),
    "pub": ("pub", "publish messages"),
}
"""Subcommand → module here that implements it, and what it does."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands."""
    parser.epilog = "examples:\n  urdfkit topic list\n  urdfkit topic echo /odom --once"
    subcommands = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND", required=True)
    for name, (module, summary) in SUBCOMMANDS.items():
        sub = subcommands.add_parser(name, help=summary, description=summary, formatter_class=HelpFormatter)
        sub.add_argument(
            "--url",
            metavar="ADDRESS",
            help="of the simulation, as `sim teleop` prints it (default: the one that is running)",
        )
        import_module(f"urdfkit.cli.topic.{module}").configure(sub, name)


def run(arguments: argparse.Namespace) -> int:
    """Run one subcommand; Ctrl-C is its way to be done."""
    from urdfkit.cli.topic.connection import talk

    module, _ = SUBCOMMANDS[arguments.subcommand]
    return talk(import_module(f"urdfkit.cli.topic.{module}").run, arguments)
