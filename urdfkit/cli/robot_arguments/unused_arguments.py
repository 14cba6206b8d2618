"""Warnings for xacro arguments that no file uses; xacro ignores them, and with them misspelt names."""

import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

from urdfkit.description.xacro.declared_arguments import unused_arguments
from urdfkit.description.xml.reader import read_source


def note_unused(arguments: Mapping[str, str], files: Iterable[Path], *, quiet: bool = False) -> None:
    """Warn of unused arguments on standard error.

    Args:
        arguments: arguments of the command line.
        files: the files of the robot.
        quiet: print nothing.
    """
    if quiet or not arguments:
        return
    for line in unused_arguments(arguments, [read_source(file) for file in files]):
        print(f"urdfkit: warning: {line}", file=sys.stderr)
