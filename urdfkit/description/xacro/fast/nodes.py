# ruff: noqa: N802, N815 - the names are those of the DOM
"""The tree that xacro works on where nobody prints it: as much of the DOM as xacro uses, and quick.

A subtree in which xacro has nothing to do (no expression, no directive, no call) is one node, whatever is in it: it is
not gone through, and a macro's call clones it as one. Comments and blank text are left out.
"""

from __future__ import annotations

from urdfkit.description.xacro.fast.templates import Pattern, in_chain
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import MAX_MADE_DEPTH, check_depth
from urdfkit.description.xml.source import Expansion, Origin, Position

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from urdfkit.description.xacro.expansion import Run
    from urdfkit.description.xml.element import Stamp


class Attributes(dict[str, str]):
    """The attributes of an element by name; may be changed while somebody goes through them."""

    __slots__ = ()

    def items(self) -> Any:
        """Return name and value of each."""
        return list(dict.items(self))

    def keys(self) -> Any:
        """Return the names."""
        return list(self)

    def copied(self) -> Attributes:
        """Return the same attributes, to be changed."""
        return Attributes(dict.items(self))


class Text:
    """A stretch of text."""

    __slots__ = ("data", "nextSibling", "parentNode", "previousSibling")

    nodeType = 3
    ELEMENT_NODE = 1

    def __init__(self, data: str) -> None:
        self.data = data
        self.parentNode: Any = None
        self.nextSibling: Any = None
        self.previousSibling: Any = None

    def copy(self, _: tuple[Expansion, ...] | None, __: Run, ___: Callable[[int], None]) -> Text:
        """Return a text that says the same."""
        return Text(self.data)


class Node:
    """An element.

    Args:
        tag: with prefix.
        attributes: of a node of its own.
        stamp: where it was written.
        run: takes note of clones.
        finished: what it becomes, where xacro has nothing to do in it; then it has neither attributes nor children.
        size: how many elements and attributes there are below, where that is not in its attributes and children.
        pattern: what it is made of, where xacro has but values to put in; then it has neither, as long as it is not
            opened.
    """

    __slots__ = (
        "attributes",
        "childNodes",
        "finished",
        "nextSibling",
        "nodeName",
        "parentNode",
        "pattern",
        "previousSibling",
        "run",
        "size",
        "stamp",
        "tagName",
    )

    nodeType = 1
    ELEMENT_NODE = 1

    def __init__(
        self,
        tag: str,
        attributes: Attributes,
        stamp: Stamp,
        run: Run,
        finished: list[Element] | None = None,
        size: int = 0,
        pattern: Pattern | None = None,
    ) -> None:
        self.pattern = pattern
        self.tagName = self.nodeName = tag
        self.attributes, self.stamp, self.run, self.finished, self.size = attributes, stamp, run, finished, size
        self.childNodes: list[Any] = []
        self.parentNode: Any = None
        self.nextSibling: Any = None
        self.previousSibling: Any = None

    @classmethod
    def of(cls, content: Element | Pattern, stamp: Stamp, run: Run) -> Node:
        """Return a node of what xacro need not go through."""
        if isinstance(content, Pattern):
            return cls(content.tag, Attributes(), stamp, run, None, content.size - 1, content)
        return cls(content.tag, Attributes(), stamp, run, [content], _size(content) - 1)

    def finish(self, element: Element) -> None:
        """Become an element that has its chain of calls already."""
        self.finished, self.pattern, self.stamp = [element], None, (*self.stamp[:3], ())

    def open(self) -> None:
        """Become a node with attributes and children of its own, for xacro to go through."""
        pattern = self.pattern
        if pattern is None:
            return
        self.attributes, self.pattern, self.size = Attributes(pattern.attributes), None, 0
        chain = self.stamp[3]
        below: list[Any] = []
        for child in pattern.children:
            at = child.position if isinstance(child, Pattern) else child.origin.position
            below.append(Node.of(child, (at.file, at.line, at.column, chain), self.run))
        for child in with_texts(below, pattern.texts):
            self.appendChild(child)

    # What xacro, and what mends its files, asks for; names as in the DOM.

    @property
    def firstChild(self) -> Any:
        """The first child."""
        return self.childNodes[0] if self.childNodes else None

    @property
    def lastChild(self) -> Any:
        """The last child."""
        return self.childNodes[-1] if self.childNodes else None

    def getUserData(self, _: str) -> Stamp:
        """Return the stamp."""
        return self.stamp

    def getAttribute(self, name: str) -> str:
        """Return the value of an attribute, empty when there is none."""
        return self.attributes.get(name, "")

    def getAttributeNode(self, name: str) -> Any:
        """Return what has the value of an attribute, None when there is none."""
        return _Value(self.attributes[name]) if name in self.attributes else None

    def hasAttribute(self, name: str) -> bool:
        """Return whether there is an attribute."""
        return name in self.attributes

    def setAttribute(self, name: Any, value: Any) -> None:
        """Give an attribute a value.

        Raises:
            AttributeError: the name is no text, as in the DOM.
        """
        name.split(":", 1)
        self.attributes[name] = value

    def removeAttribute(self, name: str) -> None:
        """Take an attribute away, if there is one."""
        if name in self.attributes:
            del self.attributes[name]

    def appendChild(self, child: Any) -> None:
        """Put a child behind the others."""
        child.parentNode = self
        if self.childNodes:
            last = self.childNodes[-1]
            last.nextSibling, child.previousSibling = child, last
        self.childNodes.append(child)

    def insertBefore(self, child: Any, behind: Any) -> None:
        """Put a child, wherever it was, before another."""
        if child.parentNode is not None:
            child.parentNode.removeChild(child)
        before = behind.previousSibling
        self.childNodes.insert(self.childNodes.index(behind), child)
        child.parentNode, child.previousSibling, child.nextSibling = self, before, behind
        behind.previousSibling = child
        if before is not None:
            before.nextSibling = child

    def removeChild(self, child: Any) -> None:
        """Take a child away."""
        self.childNodes.remove(child)
        before, behind = child.previousSibling, child.nextSibling
        if before is not None:
            before.nextSibling = behind
        if behind is not None:
            behind.previousSibling = before
        child.parentNode = child.previousSibling = child.nextSibling = None

    def cloneNode(self, deep: bool) -> Node:
        """Return a copy with all that is below, in the chain of calls that the run is in."""
        assert deep
        run: Any = self.run
        clone = self.copy(run.chain, run, run.count)
        if self is run.body:
            run.end_call()
        return clone

    def copy(self, chain: tuple[Expansion, ...] | None, run: Run, count: Callable[[int], None]) -> Node:
        """Return a copy with all that is below.

        Args:
            chain: of macro calls that led to it; None where it stays as it is.
            run: takes note of clones of the copy.
            count: is told how many elements and attributes are copied.
        """
        stamp = self.stamp if chain is None else (*self.stamp[:3], chain)
        clone = Node(self.tagName, self.attributes.copied(), stamp, run, self.finished, self.size, self.pattern)
        count(1 + len(self.attributes) + self.size)
        before: Any = None
        below = clone.childNodes
        for child in self.childNodes:
            one = child.copy(chain, run, count)
            one.parentNode, one.previousSibling = clone, before
            if before is not None:
                before.nextSibling = one
            below.append(one)
            before = one
        return clone

    def elements(self, depth: int = 0) -> list[Element]:
        """Return what it has become.

        Args:
            depth: how many elements it is in.

        Raises:
            XmlError: macros have made elements that are nested too deep.
        """
        self.open()
        file, line, column, chain = self.stamp
        if depth + self.size >= MAX_MADE_DEPTH:
            check_depth(depth, Position(file, line, column))
            for element in self.finished or ():
                _check_all(element, depth)
        if self.finished is not None:
            return [in_chain(element, chain) for element in self.finished] if chain else self.finished
        children: list[Element] = []
        text = ""
        for child in self.childNodes:
            if child.nodeType == 1:
                children += child.elements(depth + 1)
            else:
                text += child.data
        # <xacro:attribute> may leave a number where text is wanted.
        attributes = {name: str(value) for name, value in dict.items(self.attributes)}
        origin = Origin(Position(file, line, column), chain)
        return [Element(self.tagName, attributes, children, text.strip(), origin)]


def with_texts(children: list[Any], texts: list[tuple[int, str]]) -> list[Any]:
    """Return children with the texts between them; texts that are all blank are left out.

    Args:
        children: is changed.
        texts: in order: how many children come before, and what it says.
    """
    if not all(data.isspace() for _, data in texts):
        for index, data in reversed(texts):
            children.insert(index, Text(data))
    return children


def _size(element: Element) -> int:
    """Return how many elements and attributes there are in an element, itself included."""
    return 1 + len(element.attributes) + sum([_size(child) for child in element.children])


def _check_all(element: Element, depth: int) -> None:
    check_depth(depth, element.origin.position)
    for child in element.children:
        _check_all(child, depth + 1)


class Document:
    """What xacro calls a document.

    Args:
        root: the root element.
    """

    nodeType = 9

    def __init__(self, root: Node) -> None:
        self.documentElement = root
        self.childNodes = [root]


class _Value:
    """What has a value."""

    def __init__(self, value: str) -> None:
        self.value = value
