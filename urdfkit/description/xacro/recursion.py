"""Macros and files that call each other without end."""

from __future__ import annotations

MAX_MACRO_DEPTH = 400
"""Macro calls inside one another; stock xacro gives up at about 300, with Python's RecursionError."""

MAX_INCLUDE_DEPTH = 60
"""Files that include one another."""


class Endless(Exception):  # noqa: N818 - not an error of this program: diagnosed and reported as a fault
    """Macros or files call each other without end.

    Args:
        cycle: the names of those in the loop.
        what: ``macro`` or ``file``.
    """

    def __init__(self, cycle: tuple[str, ...], what: str) -> None:
        super().__init__(" → ".join(cycle))
        self.cycle, self.what = cycle, what


def cycle(names: list[str]) -> tuple[str, ...]:
    """Return the loop at the end of a stack of names, first name repeated."""
    last = names[-1]
    for distance in range(1, len(names)):
        if names[-1 - distance] == last:
            return tuple(names[-1 - distance :])
    return tuple(names[-3:])
