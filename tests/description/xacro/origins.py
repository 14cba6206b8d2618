"""Compare the origins of an expanded file with its source."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.source import Position


def misplaced(expanded: Expanded) -> Iterator[str]:
    """Yield the elements whose origin is not a start tag of their name (`xacro:element` chooses names)."""
    assert expanded.root is not None
    for element in expanded.root.walk():
        position = element.origin.position
        if not written_at(expanded, position, (f"<{element.tag}", "<xacro:element")):
            yield f"{position} <{element.tag}>"
        for call in element.origin.expansions:
            if not written_at(expanded, call.position, (f"<xacro:{call.macro}", "<xacro:call")):
                yield f"{call.position} in the chain of <{element.tag}>"


def written_at(expanded: Expanded, position: Position, beginnings: tuple[str, ...]) -> bool:
    """Whether the source has one of some texts at a position."""
    source = expanded.sources[position.file]
    return source.text.startswith(beginnings, source.offset(position.line, position.column))
