"""Warnings of a simulation on standard error: while it is built, warnings with one cause share a line."""

from __future__ import annotations

from collections.abc import Hashable, Iterable

from urdfkit.cli.sim.simulation_options import print_warning
from urdfkit.description.urdf.repair_record import ALL_PLACES, Repair
from urdfkit.notice import Notice

SMALLEST = 4
"""Number of alike warnings from which on they share a line; warnings about one missing package always do."""
_SHOWN = 3
"""Largest number of other places in a line."""


class GroupedWarnings:
    """Prints warnings; inside of a ``with`` block only at its end, those with one cause in one line.

    Warnings have one cause if they are about one missing package, or have the same `Notice.cause`.

    Args:
        quiet: print warnings only, no notes and no progress.
    """

    def __init__(self, *, quiet: bool = False) -> None:
        self._is_quiet = quiet
        self._waiting: list[Notice] | None = None

    def __call__(self, text: str) -> None:
        """Print a warning, or keep it until the end of the block."""
        notice = Notice.of(text)
        if self._is_quiet and notice.severity != "warning":
            return
        if self._waiting is None or notice.severity == "progress":
            print_warning(notice)
        else:
            self._waiting.append(notice)

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
        text = "`urdfkit lint --target urdfkit` reports the parts of a robot that are not simulated"
        print_warning(Notice(text, "note"))


def grouped(notices: Iterable[Notice]) -> list[str]:
    """Return warnings with those of one cause in one line, in the order of the first of each cause."""
    groups: dict[Hashable, list[Notice]] = {}
    for notice in notices:
        groups.setdefault(notice.package or notice.cause or notice, []).append(notice)
    found: list[str] = []
    for group in groups.values():
        if len(group) < (2 if group[0].package else SMALLEST):
            found += group
            continue
        places = list(dict.fromkeys(str(each.position) for each in group[1:] if each.position is not None))
        shown = f": {', '.join(places[:_SHOWN])}{', …' if len(places) > _SHOWN else ''}" if places else ""
        found.append(f"{group[0]} ({len(group) - 1} more with this cause{shown}; {ALL_PLACES})")
    return found
