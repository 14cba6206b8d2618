"""The options `--strict` and `--density` of every command that simulates, and the lines of its warnings."""

import argparse
import sys

from urdfkit.cli.robot_arguments.robot_loading import add_strict
from urdfkit.cli.sim import option_values
from urdfkit.notice import Notice


def add_repair_options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    add_strict(parser, "an estimated mass")
    parser.add_argument(
        "--density",
        type=option_values.positive,
        default=1000.0,
        metavar="KG/M3",
        help="density to estimate the mass of moving links without one [kg/m³] (default: 1000)",
    )


def print_warning(text: str) -> None:
    """Print a warning of a simulation, a note (`Repairs.add`) or the line before a compilation on standard error."""
    before = {"warning": "urdfkit: warning: ", "note": "urdfkit: ", "progress": ""}[Notice.of(text).severity]
    print(f"{before}{text}", file=sys.stderr, flush=True)
