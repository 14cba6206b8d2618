"""An argument parser whose errors are one line with the nearest right thing."""

from __future__ import annotations

import argparse
import re
from typing import Any, NoReturn

from urdfkit.errors import UsageError, did_you_mean


class Parser(argparse.ArgumentParser):
    """argparse, but a wrong argument raises `UsageError` instead of printing the usage."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        kwargs.setdefault("allow_abbrev", False)
        super().__init__(*args, **kwargs)

    def error(self, message: str) -> NoReturn:
        """Raise instead of exiting.

        Raises:
            UsageError: always.
        """
        hint = ""
        if unknown := re.search(r"unrecognized arguments: (\S+)", message):
            hint = did_you_mean(unknown[1], self._option_string_actions)
        elif choice := re.search(r"invalid choice: '([^']*)' \(choose from (.*)\)", message):
            hint = did_you_mean(choice[1], re.findall(r"[\w-]+", choice[2]))
        raise UsageError(f"{self.prog.removeprefix('urdfkit').strip()}: {message}{hint}".removeprefix(": "))


def add_model(parser: argparse.ArgumentParser, *, optional: bool = True) -> None:
    """Add the MODEL argument and the ``key:=value`` xacro arguments that may follow it.

    They arrive as ``arguments.model`` (a list: MODEL, if given, then ``key:=value`` words) and
    ``arguments.package_path``; `urdfkit.resources.find_model` takes both.
    """
    parser.add_argument(
        "model",
        nargs="*" if optional else "+",
        metavar="MODEL",
        help="a .urdf or .xacro file, a package folder or a robot name; then key:=value xacro arguments",
    )
    parser.add_argument(
        "--package-path",
        action="append",
        default=[],
        metavar="DIR",
        help="look for packages here too (repeatable)",
    )


def add_common(parser: argparse.ArgumentParser) -> None:
    """Add the options every command has: ``-q``, ``-v`` and ``--color``, where the command has none of its own."""
    taken = parser._option_string_actions
    if "--quiet" not in taken and "-q" not in taken:
        parser.add_argument("-q", "--quiet", action="store_true", help="print results only, no notes")
    if "--verbose" not in taken and "-v" not in taken:
        parser.add_argument("-v", "--verbose", action="store_true", help="print more notes")
    if "--color" not in taken:
        parser.add_argument(
            "--color", choices=("auto", "always", "never"), default="auto", help="colour the output (default: auto)"
        )
