"""Links and joints of a robot that a position in the source belongs to."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import element_span

if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Expansion, Position, Span

    Place = tuple[int, int]
    Hit = tuple[str, str, tuple[Expansion, ...]]
    """``link`` or ``joint``, its name, and the chain of macro calls it came through, innermost first."""


class SourceLinks:
    """Index from source text to links and joints.

    Text in a macro belongs to all elements that its calls create.

    Args:
        robot: robot expanded from the current files.
    """

    def __init__(self, robot: Robot) -> None:
        self._parts: dict[Path, list[tuple[Place, Place, Hit]]] = {}
        self._robot: Robot | None = robot
        self._source = cache(Source.read_if_possible)

    def of(self, span: Span) -> list[Hit]:
        """Return the links and joints that a span belongs to, in document order."""
        if self._robot is not None:
            for owner, name, element in _owners(self._robot):
                self._add(owner, name, element)
            self._robot = None
        start = (span.line, span.column)
        parts = self._parts.get(_real(span.file), [])
        found = {
            (owner, name): (owner, name, chain) for begin, end, (owner, name, chain) in parts if begin <= start < end
        }
        return list(found.values())

    def _add(self, owner: str, name: str, whole: Element) -> None:
        """Record the text of a link or joint: its element, and its parts from other files or macros."""
        above = None
        for element in whole.walk():
            origin = element.origin
            written = (origin.position.file, origin.expansions)
            if written != above and (end := self._end(origin.position)) is not None:
                begin = (origin.position.line, origin.position.column)
                parts = self._parts.setdefault(_real(origin.position.file), [])
                parts.append((begin, end, (owner, name, origin.expansions)))
            above = written

    def _end(self, position: Position) -> Place | None:
        source = self._source(position.file)
        span = element_span(source, position) if source is not None else None
        return None if span is None else (span.end_line, span.end_column)


def _owners(robot: Robot) -> Iterator[tuple[str, str, Element]]:
    yield from (("link", link.name, link.element) for link in robot.links)
    yield from (("joint", joint.name, joint.element) for joint in robot.joints)


def _real(file: str) -> Path:
    return (Path.cwd() / file).resolve()
