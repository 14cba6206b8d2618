"""Warnings for xacro arguments that no file uses; xacro ignores them, and with them misspelt names."""

import re
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

from urdfkit.errors import did_you_mean

_DECLARED = re.compile(r"""<\s*(?:\w+:)?arg\b[^>]*?\bname\s*=\s*["']([^"']+)["']""")


def note_unused(arguments: Mapping[str, str], files: Iterable[Path], *, quiet: bool = False) -> None:
    """Warn of unused arguments on standard error.

    Args:
        arguments: arguments of the command line.
        files: the files of the robot.
        quiet: print nothing.
    """
    if quiet or not arguments:
        return
    for line in unused(arguments, [file.read_text("utf-8", "replace") for file in files]):
        print(f"urdfkit: warning: {line}", file=sys.stderr)


def unused(arguments: Mapping[str, str], texts: Iterable[str]) -> list[str]:
    """Return one line per argument that is neither declared nor used, with the nearest declared name.

    Args:
        arguments: arguments of the command line.
        texts: texts of all files.
    """
    texts = list(texts)
    declared = [name for text in texts for name in _DECLARED.findall(text)]
    lines = []
    for name in arguments:
        own = re.escape(name)
        use = re.compile(rf"\$\(arg\s+{own}\s*\)|\$\(eval\b[^<\"]*?\b{own}\b|\bxacro\.arg\(.{own}.\)")
        if name not in declared and not any(use.search(text) for text in texts):
            available = (
                f" (declared: {', '.join(dict.fromkeys(declared))})" if declared else "; the robot declares none"
            )
            lines.append(f"no file uses the argument `{name}`{did_you_mean(name, declared) or available}")
    return lines
