"""Xacro arguments that no file uses: xacro takes them in silence, and a typing error with them."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable, Mapping

from urdfkit.errors import did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path

_DECLARED = re.compile(r"""<\s*(?:\w+:)?arg\b[^>]*?\bname\s*=\s*["']([^"']+)["']""")


def note_unused(arguments: Mapping[str, str], files: Iterable[Path], *, quiet: bool = False) -> None:
    """Warn of arguments that no file uses, on standard error.

    Args:
        arguments: as given.
        files: those that were read.
        quiet: say nothing.
    """
    if quiet or not arguments:
        return
    for line in unused(arguments, [file.read_text("utf-8", "replace") for file in files]):
        print(f"urdfkit: warning: {line}", file=sys.stderr)


def unused(arguments: Mapping[str, str], texts: Iterable[str]) -> list[str]:
    """Return a line for each argument that is neither declared nor used, with the nearest that is.

    Args:
        arguments: as given.
        texts: of all files.
    """
    texts = list(texts)
    declared = [name for text in texts for name in _DECLARED.findall(text)]
    found = []
    for name in arguments:
        own = re.escape(name)
        use = re.compile(rf"\$\(arg\s+{own}\s*\)|\$\(eval\b[^<\"]*?\b{own}\b|\bxacro\.arg\(.{own}.\)")
        if name not in declared and not any(use.search(text) for text in texts):
            known = f" (there are {', '.join(dict.fromkeys(declared))})" if declared else "; it has none"
            found.append(f"no file uses the argument `{name}`{did_you_mean(name, declared) or known}")
    return found
