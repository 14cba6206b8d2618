"""Memory of an editor: after a change in one place of a file, only the element around it is read again."""

from __future__ import annotations

from collections.abc import Callable

from urdfkit.description.xacro.evaluation.tree import CDATA, TEXT, Tag
from urdfkit.description.xacro.evaluation.tree_reader import read_tree
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import MAX_ATTRIBUTES, MAX_TAGS, MAX_VALUE, document_of
from urdfkit.description.xml.source import Position, Source
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.urdf.values import Part

    Read = Callable[[Source], Any]


class Record:
    """What one child read and did.

    Args:
        reads: whether a macro was looked up, the name, and what `_current` returned.
        commands: ``find …``, ``arg …`` and the like, with their values.
        collected: for each collection of the evaluator that grows, the added entries.
        counts: for each limit of the evaluator, the amount used.
    """

    __slots__ = ("collected", "commands", "counts", "reads")

    def __init__(
        self,
        reads: list[tuple[bool, Any, Any]],
        commands: dict[str, Any],
        collected: list[tuple[str, Any]],
        counts: list[int],
    ) -> None:
        self.reads, self.commands, self.collected, self.counts = reads, commands, collected, counts


class Child:
    """A child of a root element, as it was read.

    Attributes:
        tag: never changed; has no parent.
        record: the names and commands it read; None if a `Record` cannot hold them.
        elements: its expansion, or the expansion of its predecessor.
    """

    __slots__ = ("elements", "record", "tag")

    def __init__(self, tag: Tag) -> None:
        tag.remove()
        self.tag = tag
        self.record: Record | None = None
        self.elements: list[Element] = []


class Root(Tag):
    """The root element of a file; its children are those of the memory.

    Attributes:
        remembered: the children.
    """

    __slots__ = ("remembered",)

    def __init__(self, tag: Tag, children: list[Child]) -> None:
        super().__init__(tag.tag, dict(tag.attributes), tag.position, ())
        self.remembered = children


class Memory:
    """The files as they were when they were last well-formed, and the elements read from them.

    Attributes:
        parts: the parts of robots, for `urdfkit.description.urdf.parser.parse`.
    """

    def __init__(self) -> None:
        self.parts: dict[Element, Part] = {}
        self._files: dict[tuple[str, bool], Whole] = {}

    def element(self, source: Source) -> Element:
        """Read a file as `document_of` does.

        Raises:
            XmlError: it is not well-formed, or hostile.
        """
        key = (source.file, True)
        whole = self._edited(key, source, document_of)
        if whole is None:
            root = document_of(source)
            whole = self._files[key] = Whole(source.text, root, list(root.children), root.text)
        root = whole.root
        return Element(root.tag, root.attributes, list(whole.children), root.text, root.origin)

    def document(self, source: Source, read: Read, effects: Callable[[], Any], is_clean: Callable[[Tag], bool]) -> Tag:
        """Read a file as `read` does.

        Args:
            source: the text.
            read: reads the whole file.
            effects: returns something else if `read` has recorded anything.
            is_clean: returns whether `read` records nothing about a part of the file.

        Raises:
            XmlError: it is not well-formed, or hostile.
        """

        def part(source: Source) -> Tag:
            document = read_tree(source)
            if not is_clean(document):
                raise XmlError("not clean")
            return next(document.tags())

        key = (source.file, False)
        whole = self._edited(key, source, part)
        if whole is None:
            before = effects()
            document: Tag = read(source)
            root = next(document.tags())
            text = "".join(node.data for node in root.children() if node.kind in (TEXT, CDATA)).strip()
            if effects() != before or not _is_open(source.text) or "xacro:eval-comments" in source.text or text:
                return document
            children = [Child(tag) for tag in list(root.tags())]
            if (earlier := self._files.get(key)) is not None:
                for child, old in zip(children, earlier.children):  # noqa: B905 - as far as there are both
                    child.elements = old.elements
            whole = self._files[key] = Whole(source.text, root, children, text)
        document = Tag("", {}, Position(source.file, 1, 1), ())
        document.append(Root(whole.root, whole.children))
        return document

    def _edited(self, key: tuple[str, bool], source: Source, read: Read) -> Whole | None:
        earlier = self._files.get(key)
        whole = earlier.edited(source, read) if earlier is not None else None
        if whole is not None:
            self._files[key] = whole
        return whole


class Whole:
    """A well-formed text and the children of its root element.

    Attributes:
        root: the root element; only its tag, attributes and place count.
        children: of the root element, in order: elements, or what `Memory` keeps of them.
    """

    def __init__(
        self, text: str, root: Any, children: list[Any], content: str, starts: list[int] | None = None
    ) -> None:
        self.text, self.root, self.children, self._content = text, root, children, content
        self._starts = starts
        self._is_open = _is_open(text)

    def edited(self, source: Source, read: Read) -> Whole | None:
        """Return the children of a text that differs in one place; None if it has to be read as a whole.

        Args:
            source: the text.
            read: reads the root element of a part of it.
        """
        text, old = source.text, self.text
        if text == old:
            return self
        close = _close(old)
        if not self.children or close is None or not self._is_open or not _is_open(text) or self._content:
            return None
        if text.count("<") > MAX_TAGS or "xacro:eval-comments" in text:
            return None
        starts = self._starts
        if starts is None:
            before = Source(source.file, old)
            starts = [before.offset(*_place(child)) for child in self.children]
        from bisect import bisect_right

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
        if not new or _macros(new) != _macros([self.children[index]]):
            return None
        if isinstance(new[0], Child):
            new[0].elements = self.children[index].elements
        children = [*self.children[:index], *new, *self.children[index + 1 :]]
        places = [alone.offset(*_place(child)) for child in new]
        shift = starts[index] - len(opening) - (line - 1) - (column - 1)
        later = [start + longer for start in starts[index + 1 :]]
        return Whole(text, self.root, children, "", [*starts[:index], *(place + shift for place in places), *later])


def _is_open(text: str) -> bool:
    """Whether markup can be recognized from the text alone: no CDATA, no document type, no UTF-16."""
    return "<!" not in text.replace("<!--", "") and "\0" not in text


def _children(root: Any) -> list[Any]:
    """Return the children of a root element as `Memory` keeps them; nothing if there is text between them."""
    if isinstance(root, Element):
        return [] if root.text else root.children
    if any(node.kind in (TEXT, CDATA) and not node.data.isspace() for node in root.children()):
        return []
    return [Child(tag) for tag in list(root.tags())]


def _place(child: Any) -> tuple[int, int]:
    """Return line and column."""
    at = child.tag.position if isinstance(child, Child) else child.origin.position
    return at.line, at.column


def _macros(children: list[Any]) -> list[str | None]:
    """Return the names of the macros that are defined: how other elements are read depends on them."""
    found: list[str | None] = []
    for child in children:
        pending = [child.tag] if isinstance(child, Child) else []
        for tag in pending:  # The list grows during the iteration.
            if tag.tag in ("macro", "xacro:macro"):
                found.append(tag.attributes.get("name"))
            pending += tag.tags()
    return found


def _tags(root: Any) -> tuple[str, str]:
    """Return start and end tag of an element that declares the prefixes that the root does."""
    declared = [(name, value) for name, value in root.attributes.items() if name.startswith("xmlns")]
    written = "".join(f' {name}="{_escaped(value)}"' for name, value in declared)
    return f"<{root.tag}{written}>", f"</{root.tag}>"


def _escaped(value: str) -> str:
    return value.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;")


def _close(text: str) -> int | None:
    """Return where the end tag of the root is; None if other text follows it."""
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


def adopted(new: Element, old: Element) -> Element:
    """Return the old element if the new element is equal, else the new element with equal children of the old."""
    if len(new.children) != len(old.children):
        return new
    is_same = True
    for index, (child, before) in enumerate(zip(new.children, old.children, strict=True)):
        if adopted(child, before) is before:
            new.children[index] = before
        else:
            is_same = False
    if not is_same or new.tag != old.tag or new.attributes != old.attributes or new.text != old.text:
        return new
    here, there = new.origin.position, old.origin.position
    is_here = here.line == there.line and here.column == there.column and here.file == there.file
    return old if is_here and new.origin.expansions == old.origin.expansions else new
