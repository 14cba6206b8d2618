"""Colors of the output of commands in a terminal."""

import os
import sys

_OF_DIFF = {"+": "32", "-": "31", "@": "36"}
"""Number of the color of a line of a diff, by its first character (SGR, ECMA-48)."""


def uses_color(choice: str = "auto") -> bool:
    """Return whether the output is in color.

    Args:
        choice: ``always``, ``never``, or ``auto``: in a terminal, unless ``NO_COLOR`` is set (https://no-color.org).
    """
    if choice != "auto":
        return choice == "always"
    return sys.stdout.isatty() and not os.environ.get("NO_COLOR") and os.environ.get("TERM") != "dumb"


def colored_diff(text: str, choice: str = "auto") -> str:
    """Return the text of a diff, with its lines in color where the output is; see `uses_color`."""
    if not uses_color(choice):
        return text
    lines = text.split("\n")
    return "\n".join(f"\x1b[{_OF_DIFF[line[0]]}m{line}\x1b[0m" if line[:1] in _OF_DIFF else line for line in lines)
