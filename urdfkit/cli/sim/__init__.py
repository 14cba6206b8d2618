"""`urdfkit sim`: simulate a robot.

One module per subcommand reads its options and prints its result; `urdfkit.app.simulation` runs the simulation.
"""

import argparse
from importlib import import_module

from urdfkit.cli.parser import Parser, add_common

SUBCOMMANDS = {
    "teleop": ("teleop", "drive a robot in real time, in the browser or the terminal"),
    "run": ("run_command", "simulate headless, faster than real time, and report the final state"),
    "sweep": ("sweep_command", "simulate a robot with many combinations of parameters, and tabulate metrics"),
    "warmup": ("warmup", "compile the physics kernel now, not on first use"),
}
"""Subcommand → module that implements it, and its description. (A module `run` would hide the function.)"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the subcommands."""
    parser.epilog = (
        "examples:\n  urdfkit sim teleop simpleton\n  urdfkit sim run simpleton --for 10 --cmd-vel 0.5,0,0.5"
    )
    subcommands = parser.add_subparsers(dest="subcommand", metavar="SUBCOMMAND", required=True)
    if isinstance(parser, Parser):
        parser.default_subcommand = "teleop"
    for name, (module, summary) in SUBCOMMANDS.items():
        sub = subcommands.add_parser(
            name, help=summary, description=summary, formatter_class=argparse.RawDescriptionHelpFormatter
        )
        import_module(f"urdfkit.cli.sim.{module}").configure(sub)
        add_common(sub)


def run(arguments: argparse.Namespace) -> int:
    """Run one subcommand."""
    module, _ = SUBCOMMANDS[arguments.subcommand]
    return int(import_module(f"urdfkit.cli.sim.{module}").run(arguments))
