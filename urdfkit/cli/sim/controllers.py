"""``--controllers``: which parameter files configure the robot's controllers."""

from __future__ import annotations

import argparse


def add_controllers(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--controllers",
        action="append",
        default=[],
        metavar="FILE.yaml",
        help="parameters of controllers, in place of those the robot's packages load (repeatable)",
    )
