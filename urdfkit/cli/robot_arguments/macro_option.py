"""The option ``--macro``: instantiate a macro of a file that defines macros only."""

from __future__ import annotations

import argparse
from dataclasses import replace

from urdfkit.resources import ModelArgument


def add_macro(parser: argparse.ArgumentParser) -> None:
    """Add the option."""
    parser.add_argument(
        "--macro",
        metavar="NAME",
        help="instantiate this macro of the file; key:=value arguments also set its parameters",
    )


def with_macro(model: ModelArgument, arguments: argparse.Namespace) -> ModelArgument:
    """Return a robot with the macro of the command line.

    Args:
        model: the robot.
        arguments: with the option of `add_macro`.
    """
    return replace(model, macro=arguments.macro)
