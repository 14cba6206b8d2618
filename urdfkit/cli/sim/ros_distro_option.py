"""The option `--ros-distro` of every command that simulates."""

import argparse


def add_distro(parser: argparse.ArgumentParser) -> None:
    """Add the option; the simulator checks its value."""
    parser.add_argument(
        "--ros-distro",
        metavar="NAME",
        help="reproduce the behaviour of this ROS distribution, e.g. kinetic (default: the newest)",
    )
