"""Warnings for xacro arguments that no file uses; xacro ignores them, and with them misspelt names."""

import sys
from collections.abc import Iterable
from pathlib import Path

from urdfkit.description.xacro.declared_arguments import unused_arguments
from urdfkit.description.xml.reader import read_source
from urdfkit.resources import ModelArgument


def note_unused(model: ModelArgument, files: Iterable[Path], *, quiet: bool = False) -> None:
    """Warn of unused arguments on standard error.

    Args:
        model: the robot of the command line.
        files: the files of the robot.
        quiet: print nothing.
    """
    if quiet or not model.arguments:
        return
    for line in unused_arguments(model.arguments, [read_source(file) for file in files], model.macro):
        print(f"urdfkit: warning: {line}", file=sys.stderr)
