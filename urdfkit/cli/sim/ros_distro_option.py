"""The option `--ros-distro`, of every command that simulates."""

from __future__ import annotations

import argparse


def add_distro(parser: argparse.ArgumentParser) -> None:
    """Add the option; its value is checked by who needs it."""
    parser.add_argument(
        "--ros-distro",
        metavar="NAME",
        help="behave as this ROS distribution did, e.g. kinetic (default: the newest)",
    )
