"""What an editor remembers between two looks at a file: after one change, only what is around it is read anew."""

from __future__ import annotations

from bisect import bisect_right

from urdfkit.description.xacro.fast.nodes import Document, Node
from urdfkit.description.xacro.fast.reader import planted
from urdfkit.description.xacro.fast.reuse import adopt, are_alike
from urdfkit.description.xacro.fast.templates import Shelf
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import MAX_ATTRIBUTES, MAX_TAGS, MAX_VALUE, document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from urdfkit.description.urdf.values import Part
    from urdfkit.description.xacro.expansion import Run

    Read = Callable[[Source], Any]


class Memory:
    """The files as they were when they were last well-formed, and the parts of robots that were read from them."""

    def __init__(self) -> None:
        self.parts: dict[Element, Part] = {}
        self._files: dict[tuple[str, bool], Whole] = {}
        self._elements: dict[tuple[object, ...], Element] = {}
        self.shelf = Shelf()

    def settle(self, root: Element | None) -> None:
        """Put the elements of last time in the place of those below the root that have come out the same."""
        self.shelf.turn()
        if root is None:
            return
        known, self._elements = self._elements, {}
        for index, element in enumerate(root.children):
            at = element.origin
            calls = at.expansions and (at.expansions[0].macro, at.expansions[0].position.line)
            key = (element.tag, element.attributes.get("name"), at.position.line, at.position.column, calls)
            old = known.get(key)
            if old is not None and old is not element and are_alike(old, element):
                root.children[index] = element = old
            self._elements[key] = element

    def element(self, source: Source) -> Element:
        """Read a file as `document_of` does.

        Raises:
            XmlError: it is not well-formed, or hostile.
        """
        whole = self._whole(source, _read_element, is_plain=True)
        root: Element = whole.root
        return Element(root.tag, root.attributes, list(whole.children), root.text, root.origin)

    def document(self, source: Source, run: Run) -> Document:
        """Read a file as `planted` does.

        Raises:
            XmlError: it is not well-formed, or hostile.
        """
        whole = self._whole(source, _read_node, is_plain=False)
        pristine: Node = whole.root
        root = Node(pristine.tagName, pristine.attributes.copied(), pristine.stamp, run)
        for child in whole.children:
            root.appendChild(child.copy(None, run, _uncounted))
        return Document(root)

    def _whole(self, source: Source, read: Read, *, is_plain: bool) -> Whole:
        key = (source.file, is_plain)
        known = self._files.get(key)
        whole = known.edited(source, read) if known is not None else None
        if whole is None:
            whole = Whole(source.text, read(source))
        self._files[key] = whole
        return whole


class Whole:
    """A well-formed text and what is in its root element.

    Attributes:
        root: the root element; what is in it may be older than `children`.
        children: what is in the root element, in order.
    """

    def __init__(
        self, text: str, root: Any, children: list[Any] | None = None, starts: list[int] | None = None
    ) -> None:
        self.text, self.root = text, root
        self.children: list[Any] = _children(root) if children is None else children
        self._starts = starts
        self._is_open = _is_open(text)

    def edited(self, source: Source, read: Read) -> Whole | None:
        """Return what a text is that differs from this in one place; None where it has to be read as a whole."""
        text, old = source.text, self.text
        if text == old:
            return self
        close = _close(old)
        if not self.children or close is None or not self._is_open or not _is_open(text):
            return None
        if any(_is_text(child) for child in self.children) or _text(self.root) or text.count("<") > MAX_TAGS:
            return None
        starts = self._starts
        if starts is None:
            before = Source(source.file, old)
            starts = [before.offset(*_place(child)) for child in self.children]
        first = _same(old, text)
        last = len(old) - _same(old[first:][::-1], text[first:][::-1])
        index = bisect_right(starts, first) - 1
        end = starts[index + 1] if index + 1 < len(starts) else close
        longer = len(text) - len(old)
        cut, put = old[first:last], text[first : last + longer]
        if index < 0 or last > end or "\n" not in old[last:end]:
            return None
        if any(cut.count(sign) != put.count(sign) for sign in "\r\n"):
            return None  # What follows would be in another line.
        line, column = _place(self.children[index])
        piece = text[starts[index] : end + longer]
        if line == 1 or (len(text) > MAX_VALUE and piece.count("=") > MAX_ATTRIBUTES):
            return None
        opening, closing = _tags(self.root)
        alone = Source(source.file, f"{opening}{chr(10) * (line - 1)}{' ' * (column - 1)}{piece}{closing}")
        try:
            around = read(alone)
        except XmlError:
            return None
        new = _children(around)
        if not new or _text(around) or any(_is_text(child) for child in new):
            return None
        adopt(new[0], self.children[index])
        children = [*self.children[:index], *new, *self.children[index + 1 :]]
        places = [alone.offset(*_place(child)) for child in new]
        shift = starts[index] - len(opening) - (line - 1) - (column - 1)
        later = [start + longer for start in starts[index + 1 :]]
        return Whole(text, self.root, children, [*starts[:index], *(place + shift for place in places), *later])


def _is_open(text: str) -> bool:
    """Whether what is markup can be told from the text alone: no CDATA, no document type, no UTF-16."""
    return "<!" not in text.replace("<!--", "") and "\0" not in text


def _read_element(source: Source) -> Element:
    return document_of(source)


def _read_node(source: Source) -> Any:
    nobody: Any = None
    return planted(source, nobody).documentElement


def _uncounted(_: int) -> None:
    """Count nothing: these are no clones that a person's macros make."""


def _children(root: Any) -> list[Any]:
    return list(root.children if isinstance(root, Element) else root.childNodes)


def _text(root: Any) -> str:
    return root.text if isinstance(root, Element) else ""


def _is_text(child: Any) -> bool:
    return not isinstance(child, Element) and child.nodeType != 1


def _place(child: Any) -> tuple[int, int]:
    """Return line and column."""
    if isinstance(child, Element):
        return child.origin.position.line, child.origin.position.column
    return child.stamp[1], child.stamp[2]


def _tags(root: Any) -> tuple[str, str]:
    """Return start and end tag of an element that declares the prefixes that the root does."""
    tag = root.tag if isinstance(root, Element) else root.tagName
    declared = [(name, value) for name, value in root.attributes.items() if name.startswith("xmlns")]
    written = "".join(f' {name}="{_escaped(value)}"' for name, value in declared)
    return f"<{tag}{written}>", f"</{tag}>"


def _escaped(value: str) -> str:
    return value.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")


def _close(text: str) -> int | None:
    """Return where the end tag of the root is; None where it is not the last thing in the text."""
    at = text.rfind("</")
    return at if at != -1 and text[at:].rstrip().find(">") == len(text[at:].rstrip()) - 1 else None


def _same(one: str, other: str) -> int:
    """Return how many characters two texts begin with alike."""
    low, high = 0, min(len(one), len(other))
    while low < high:
        middle = (low + high + 1) // 2
        if one[low:middle] == other[low:middle]:
            low = middle
        else:
            high = middle - 1
    return low
