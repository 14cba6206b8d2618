"""`urdfkit topic`: inspect and publish topics of a simulation or live robot, as ``rostopic`` and ``ros2 topic`` do.

A topic goes in; its messages, rate or bandwidth are printed.
"""

import argparse
from importlib import import_module

from urdfkit.cli.parser import HelpFormatter
from urdfkit.cli.topic.connection import add_connection_options, run_with_client

SUBCOMMANDS = {
    "list": ("list_topics", "list the topics"),
    "info": ("list_topics", "print type, number of messages and subscribers of a topic"),
    "type": ("list_topics", "print the type of a topic"),
    "find": ("list_topics", "print the topics of a type"),
    "echo": ("echo", "print the messages of a topic"),
    "hz": ("rates", "print the message rate of a topic in simulated time"),
    "bw": ("rates", "print the bandwidth of a topic"),
    "pub": ("pub", "publish messages"),
}
"""Subcommand → module that implements it, and its description."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands."""
    parser.epilog = (
        "examples:\n  urdfkit topic list\n  urdfkit topic echo /odom --once\n  urdfkit topic hz /scan --live ros2"
    )
    subcommands = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND", required=True)
    for name, (module, summary) in SUBCOMMANDS.items():
        sub = subcommands.add_parser(name, help=summary, description=summary, formatter_class=HelpFormatter)
        add_connection_options(sub)
        import_module(f"urdfkit.cli.topic.{module}").configure(sub, name)


def run(arguments: argparse.Namespace) -> int:
    """Run one subcommand until it is done or interrupted by Ctrl-C."""
    module, _ = SUBCOMMANDS[arguments.subcommand]
    return run_with_client(import_module(f"urdfkit.cli.topic.{module}").run, arguments)
