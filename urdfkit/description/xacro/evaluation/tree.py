"""Nodes: the tree that is expanded in place. An element carries its place and the macro calls that produced it.

The links between siblings are those of the DOM, so that directives can be replaced while their siblings are visited.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Expansion, Position

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

Chain = tuple[Expansion, ...]

NOTHING, VALUES, MORE = range(3)

TEXT, CDATA, COMMENT, INSTRUCTION, DOCTYPE, ELEMENT = "text", "cdata", "comment", "instruction", "doctype", "element"


class Node:
    """A node of the tree.

    Attributes:
        kind: of the node.
        data: text of a text or comment; of an instruction or document type, its printed content.
        parent: the element around it.
        before: the sibling before it.
        after: the sibling after it.
    """

    __slots__ = ("after", "before", "data", "kind", "parent")

    def __init__(self, kind: str, data: str = "") -> None:
        self.kind, self.data = kind, data
        self.parent: Tag | None = None
        self.before: Node | None = None
        self.after: Node | None = None

    def remove(self) -> None:
        """Take it out of its parent."""
        parent = self.parent
        if parent is None:
            return
        if self.before is not None:
            self.before.after = self.after
        else:
            parent.first = self.after
        if self.after is not None:
            self.after.before = self.before
        else:
            parent.last = self.before
        self.parent = self.before = self.after = None

    def insert_before(self, node: Node) -> None:
        """Put it before another node, in the parent of that node."""
        self.remove()
        self.parent, self.after, self.before = node.parent, node, node.before
        if node.before is not None:
            node.before.after = self
        elif node.parent is not None:
            node.parent.first = self
        node.before = self


class Tag(Node):
    """An element.

    Attributes:
        tag: its qualified name.
        name: the name that stock xacro's messages show: not changed by ``xacro:call``.
        attributes: name → value; ``xacro:attribute`` may leave a number.
        position: of its start tag.
        chain: the macro calls that produced it, innermost first.
        first: its first child.
        last: its last child.
        work: remaining work in the element: `NOTHING`, only computing `VALUES`, or `MORE`.
        size: how many elements and attributes it has, itself and all below it included; valid unless `work` is `MORE`.
        height: how many elements are nested in it; valid unless `work` is `MORE`.
        expressions: what `expressions_of` found.
        content: its text, None if that has expressions, and the elements in it; None until it is copied.
    """

    __slots__ = (
        "attributes",
        "chain",
        "content",
        "expressions",
        "first",
        "height",
        "last",
        "name",
        "position",
        "size",
        "tag",
        "work",
    )

    def __init__(self, tag: str, attributes: dict[str, Any], position: Position, chain: Chain) -> None:
        self.kind, self.data = ELEMENT, ""
        self.parent = self.before = self.after = None
        self.first: Node | None = None
        self.last: Node | None = None
        self.tag = self.name = tag
        self.attributes, self.position, self.chain = attributes, position, chain
        self.work, self.size, self.height = MORE, 0, 0
        self.expressions: list[tuple[Position, str | None, str]] | None = None
        self.content: tuple[str | None, list[Tag]] | None = None

    def append(self, node: Node) -> None:
        """Add a child that has no parent."""
        node.parent, node.before = self, self.last
        if self.last is not None:
            self.last.after = node
        else:
            self.first = node
        self.last = node

    def children(self) -> Iterator[Node]:
        """Yield the children."""
        child = self.first
        while child is not None:
            yield child
            child = child.after

    def tags(self) -> Iterator[Tag]:
        """Yield the child elements."""
        for child in self.children():
            if isinstance(child, Tag):
                yield child

    def copy(self, chain: Chain | None, count: Callable[[int], None]) -> Tag:
        """Return a copy with all below it.

        Args:
            chain: the macro calls of the copy; None keeps those of each element.
            count: called with the number of elements and attributes of each element.
        """
        if self.work < MORE:
            count(self.size)
            return Copy(self, self.chain if chain is None else chain)
        top = Tag(self.tag, dict(self.attributes), self.position, self.chain if chain is None else chain)
        open_tags = [(self, top)]
        while open_tags:
            source, made = open_tags.pop()
            count(1 + len(made.attributes))
            child = source.first
            while child is not None:
                new: Node
                if not isinstance(child, Tag):
                    new = Node(child.kind, child.data)
                elif child.work < MORE:
                    new = child.copy(chain, count)
                else:
                    kept = child.chain if chain is None else chain
                    new = Tag(child.tag, dict(child.attributes), child.position, kept)
                    open_tags.append((child, new))
                made.append(new)
                child = child.after
        return top

    def replace(self, sources: list[Tag]) -> None:
        """Put the children of other elements in the place of this one."""
        for source in sources:
            child = source.first
            while child is not None:
                following = child.after
                child.insert_before(self)
                child = following
        self.remove()


class Copy(Tag):
    """A copy of an element in which at most values have to be computed; its children are made when they are read.

    Attributes:
        source: the element that is copied; None after the children were made.
        values: those of the expressions of the source, in order; None before they are computed.
    """

    __slots__ = ("_attributes", "_first", "_last", "source", "values")

    def __init__(self, source: Tag, chain: Chain) -> None:
        self.kind, self.data = ELEMENT, ""
        self.parent = self.before = self.after = None
        self.tag, self.name, self.position, self.chain = source.tag, source.name, source.position, chain
        self.work, self.size, self.height, self.expressions = source.work, source.size, source.height, None
        self.content = None
        self.values: list[str] | None = None
        self._first: Node | None = None
        self._last: Node | None = None
        if type(source) is Copy and source.source is not None:
            self.source: Tag | None = source.source
            self.values = source.values
        else:
            self.source = source

    def open(self) -> None:
        """Make the attributes and children."""
        if self.source is None:
            return
        source, self.source = self.source, None
        values = iter(self.values) if self.values is not None else None
        self._attributes = dict(source.attributes)
        open_tags: list[tuple[Tag, Tag, Node | None]] = [(source, self, source.first)]
        self._put(self, values)
        while open_tags:
            tag, made, child = open_tags.pop()
            while child is not None:
                if isinstance(child, Tag):
                    new = Tag(child.tag, dict(child.attributes), child.position, self.chain)
                    new.work, new.size, new.height = child.work, child.size, child.height
                    self._put(new, values)
                    made.append(new)
                    open_tags += [(tag, made, child.after), (child, new, child.first)]
                    break
                is_value = values is not None and child.kind == TEXT and "$" in child.data
                made.append(Node(child.kind, next(values) if is_value else child.data))  # type: ignore[arg-type]
                child = child.after

    def _put(self, tag: Tag, values: Iterator[str] | None) -> None:
        if values is not None:
            for name, value in tag.attributes.items():
                if "$" in value:
                    tag.attributes[name] = next(values)

    @property
    def attributes(self) -> dict[str, Any]:
        """Its attributes."""
        self.open()
        return self._attributes

    @attributes.setter
    def attributes(self, attributes: dict[str, Any]) -> None:
        self._attributes = attributes

    @property
    def first(self) -> Node | None:
        """Its first child."""
        self.open()
        return self._first

    @first.setter
    def first(self, node: Node | None) -> None:
        self._first = node

    @property
    def last(self) -> Node | None:
        """Its last child."""
        self.open()
        return self._last

    @last.setter
    def last(self, node: Node | None) -> None:
        self._last = node


class ExpandedElements(Tag):
    """Stands for elements that are expanded already.

    Attributes:
        elements: the elements; nested less than half as deep as is allowed.
    """

    __slots__ = ("elements",)

    def __init__(self, elements: list[Element], position: Position) -> None:
        super().__init__("", {}, position, ())
        self.elements = elements


def expressions_of(tag: Tag) -> list[tuple[Position, str | None, str]]:
    """Return the texts with expressions in an element and below, in order: element, attribute and text."""
    found = tag.expressions
    if found is None:
        found = tag.expressions = []
        if tag.work == VALUES:
            found += [(tag.position, name, value) for name, value in tag.attributes.items() if "$" in value]
            for child in tag.children():
                if isinstance(child, Tag):
                    found += expressions_of(child)
                elif child.kind == TEXT and "$" in child.data:
                    found.append((tag.position, None, child.data))
    return found
