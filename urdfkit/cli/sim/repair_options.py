"""The options `--strict` and `--density` of every command that simulates."""

from __future__ import annotations

import argparse

from urdfkit.cli.sim import option_values


def add_repair_options(parser: argparse.ArgumentParser) -> None:
    """Add the options."""
    parser.add_argument(
        "--strict",
        action="store_true",
        help="refuse robots that need a repair, such as an estimated mass (default: repair and warn)",
    )
    parser.add_argument(
        "--density",
        type=option_values.positive,
        default=1000.0,
        metavar="KG/M3",
        help="density from which to estimate the mass of moving links that have none [kg/m³] (default: 1000)",
    )
