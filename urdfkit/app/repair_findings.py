"""Repairs on the page and in the terminal: rows of the findings panel, and one line for each repair."""

from collections.abc import Callable, Collection, Iterable
from functools import cache
from pathlib import Path
from typing import Any

from urdfkit.app.page import note
from urdfkit.description.urdf.repair_record import Repair, grouped
from urdfkit.description.xml.source import Source

Row = dict[str, Any]


def note_repairs(repairs: Iterable[Repair], noted: Collection[str] = ()) -> set[str]:
    """Print each repair once; see `grouped`.

    Args:
        repairs: the repairs.
        noted: messages that have been printed before.

    Returns:
        The messages of these repairs.
    """
    messages: dict[str, Repair] = {}
    for repair in repairs:
        messages.setdefault(repair.message, repair)
    for repair in grouped(repair for message, repair in messages.items() if message not in noted):
        note(f"urdfkit: {repair.severity}: {repair}")
    return set(messages)


def with_repairs(rows: list[Row], repairs: Iterable[Repair], *, first: int = 1) -> list[Row]:
    """Return the findings of the page with the repairs.

    A repair is added to the finding of the same rule in the same line, or in a macro call, where values that a macro
    only hands on are reported, to the one with the same link or joint. Equal repairs without a finding share a row.

    Args:
        rows: findings, one row each, as `FindingsPanel.lint` returns them; changed in place.
        repairs: the repairs.
        first: number of the first new row.
    """
    groups: dict[str, list[Repair]] = {}
    for repair in repairs:
        groups.setdefault(repair.message, []).append(repair)
    by_place = {(row["code"], _real(row["file"]), row["line"]): row for row in reversed(rows)}
    by_name = {(row["code"], row["link"] or row["joint"]): row for row in reversed(rows) if row.get("chains")}
    added: list[Row] = []
    source = cache(Source.read_if_possible)
    for message, group in groups.items():
        places = ((repair.code, repair.position) for repair in group if repair.position is not None)
        findings = (by_place.get((code, _real(at.file), at.line)) for code, at in places)
        row = next((row for row in findings if row is not None), None)
        if row is None and (name := group[0].link or group[0].joint):
            row = by_name.get((group[0].code or "", name))
        if row is None:
            row = _row(group[0], first + len(added), source)
            added.append(row)
        row["repair"] = message
        _extend(row, group)
    return [*rows, *added]


def _extend(row: Row, group: list[Repair]) -> None:
    """Add the links and joints of repairs to those of a row."""
    names = [_owner(repair.link, repair.joint) for repair in group]
    written = row["about"] or [_owner(row["link"], row["joint"])]
    unique = dict.fromkeys(tuple(name.items()) for name in (*written, *names) if name)
    row["about"] = [dict(name) for name in unique]


def _owner(link: str | None, joint: str | None) -> dict[str, str]:
    return {"link": link} if link else {"joint": joint} if joint else {}


def _row(repair: Repair, number: int, source: Callable[[str], Source | None]) -> Row:
    at = repair.position
    text = None if at is None else source(at.file)
    return {
        "code": repair.code or "",
        "name": "repair",
        "severity": repair.severity,
        "message": repair.message,
        "file": "" if at is None else at.file,
        "line": 0 if at is None else at.line,
        "column": 0 if at is None else at.column,
        "link": repair.link,
        "joint": repair.joint,
        "help": None,
        "chains": [],
        "fix": None,
        "number": number,
        "lines": [] if at is None or text is None else [text.excerpt(at.line, at.column)],
        "about": [],
    }


def _real(file: str) -> Path:
    return (Path.cwd() / file).resolve()
