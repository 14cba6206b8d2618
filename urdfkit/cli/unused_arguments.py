"""Warnings for xacro arguments that no file uses; xacro ignores them, and with them misspelt names."""

import re
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

from urdfkit.description.xacro.declared_arguments import declared_arguments
from urdfkit.description.xml.reader import read_source
from urdfkit.description.xml.source import Source
from urdfkit.errors import did_you_mean


def note_unused(arguments: Mapping[str, str], files: Iterable[Path], *, quiet: bool = False) -> None:
    """Warn of unused arguments on standard error.

    Args:
        arguments: arguments of the command line.
        files: the files of the robot.
        quiet: print nothing.
    """
    if quiet or not arguments:
        return
    for line in unused(arguments, [read_source(file) for file in files]):
        print(f"urdfkit: warning: {line}", file=sys.stderr)


def unused(arguments: Mapping[str, str], sources: Iterable[Source]) -> list[str]:
    """Return one line per argument that is neither declared nor used, with the nearest declared name.

    Args:
        arguments: arguments of the command line.
        sources: all files of the robot.
    """
    sources = list(sources)
    declared = declared_arguments(sources)
    lines = []
    for name in arguments:
        own = re.escape(name)
        use = re.compile(rf"\$\(arg\s+{own}\s*\)|\$\(eval\b[^<\"]*?\b{own}\b|\bxacro\.arg\(.{own}.\)")
        if name not in declared and not any(use.search(source.text) for source in sources):
            available = f" (declared: {', '.join(declared)})" if declared else "; the robot declares none"
            lines.append(f"no file uses the argument `{name}`{did_you_mean(name, declared) or available}")
    return lines
