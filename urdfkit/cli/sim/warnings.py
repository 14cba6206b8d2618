"""Warnings of a simulation on standard error: while it is built, warnings with one cause share a line."""

from __future__ import annotations

import re
from collections.abc import Iterable

from urdfkit.cli.sim.repair_options import print_warning
from urdfkit.description.urdf.repair_record import ALL_PLACES, Repair

SMALLEST = 4
"""Number of alike warnings from which on they share a line; warnings about one missing package always do."""
_SHOWN = 3
"""Largest number of other places in a line."""

_PLACE = re.compile(r"^(note: )?(\S+:\d+:\d+): ")
_PACKAGE = re.compile(r"no package `[^`]*`")
_NAMES = re.compile(r"`[^`]*`|mesh \S+|<[^>]*>|-?\d[\d.e+-]*")


class GroupedWarnings:
    """Prints warnings; inside of a ``with`` block only at its end, those with one cause in one line.

    Warnings about one package have one cause, and warnings that differ in names and numbers only.

    Args:
        quiet: print warnings only, no notes and no progress.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        self._is_quiet = quiet
        self._waiting: list[str] | None = None

    def __call__(self, text: str) -> None:
        """Print a warning, or keep it until the end of the block."""
        if self._is_quiet and text.startswith(("compiling ", "note: ")):
            return
        if self._waiting is None or text.startswith("compiling "):
            print_warning(text)
        else:
            self._waiting.append(text)

    def __enter__(self) -> GroupedWarnings:
        self._waiting = []
        return self

    def __exit__(self, *_: object) -> None:
        waiting, self._waiting = self._waiting or [], None
        for text in grouped(waiting):
            print_warning(text)


def note_lint_target(repairs: Iterable[Repair], *, quiet: bool) -> None:
    """Print how to find the parts that are not simulated without a simulation: other targets simulate them."""
    if not quiet and any(repair.code == "Z833" for repair in repairs):
        print_warning("note: `urdfkit lint --target urdfkit` reports the parts of a robot that are not simulated")


def grouped(texts: list[str]) -> list[str]:
    """Return warnings with those of one cause in one line, in the order of the first of each cause."""
    groups: dict[str, list[str]] = {}
    for text in texts:
        package = _PACKAGE.search(text)
        groups.setdefault(_NAMES.sub("…", _PLACE.sub("", text)) if package is None else package[0], []).append(text)
    found = []
    for cause, group in groups.items():
        if len(group) < (2 if _PACKAGE.fullmatch(cause) else SMALLEST):
            found += group
            continue
        matches = [_PLACE.match(text) for text in group[1:]]
        places = list(dict.fromkeys(match[2] for match in matches if match is not None))
        shown = f": {', '.join(places[:_SHOWN])}{', …' if len(places) > _SHOWN else ''}" if places else ""
        found.append(f"{group[0]} ({len(group) - 1} more with this cause{shown}; {ALL_PLACES})")
    return found
