"""The option `--renderer`, of every command that simulates."""

from __future__ import annotations

import argparse


def add_renderer(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--renderer",
        choices=("auto", "ray", "gl"),
        default="auto",
        help="who takes the cameras' pictures: ray casts rays, gl draws by OpenGL, auto whichever is quicker "
        "(default: auto)",
    )
