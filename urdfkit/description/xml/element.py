"""Element: one expanded XML element with its source position."""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xml.source import Origin
from urdfkit.record import field, record

MAX_DEPTH = 200
"""Maximum nesting depth of the elements of a description; real descriptions have a depth of less than 20."""


@record(eq=False)
class Element:
    """An XML element after expansion.

    Attributes:
        tag: qualified name, e.g. ``link`` or ``xacro:macro``.
        attributes: name → value after expansion, in document order.
        children: child elements in document order (without comments and processing instructions).
        text: the character data directly inside, concatenated and stripped.
        origin: source position of the start tag, and the macro calls that produced the element.
    """

    tag: str
    attributes: dict[str, str]
    children: list[Element]
    text: str
    origin: Origin = field(repr=False)

    def __init__(
        self, tag: str, attributes: dict[str, str], children: list[Element], text: str, origin: Origin
    ) -> None:  # faster than that of records
        values = self.__dict__
        values["tag"], values["attributes"], values["children"] = tag, attributes, children
        values["text"], values["origin"] = text, origin

    def get(self, attribute: str, default: str | None = None) -> str | None:
        """Return an attribute's value."""
        return self.attributes.get(attribute, default)

    def find(self, tag: str) -> Element | None:
        """Return the first child with this tag."""
        for child in self.children:
            if child.tag == tag:
                return child
        return None

    def find_all(self, tag: str) -> list[Element]:
        """Return all children with this tag."""
        return [child for child in self.children if child.tag == tag]

    def walk(self) -> Iterator[Element]:
        """Yield this element and all below it, in document order."""
        yield self
        for child in self.children:
            yield from child.walk()
