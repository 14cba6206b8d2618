"""Subtrees in which xacro has nothing to do but put values in: made into elements at once, and remembered.

A `Pattern` is what a person wrote, with its expressions. Where all that these need are names with simple values, a
`Maker` makes the `Element` without xacro going through it; elsewhere its node is opened, and xacro does.
"""

from __future__ import annotations

from urdfkit.description.xacro.expressions.excess import MAX_CHARACTERS
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Expansion, Origin, Position

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from urdfkit.description.xacro.expressions.evaluation import Evaluator

    Chain = tuple[Expansion, ...]

_SIMPLE = (int, float, bool, str)


class Pattern:
    """An element with expressions, as written: neither directives nor calls are in it.

    Args:
        tag: without prefix.
        attributes: with expressions.
        children: those without expressions are elements already.
        texts: what is directly inside: how many children come before, and the text.
        position: of the start tag.
        size: how many elements and attributes there are in it, itself included.

    Attributes:
        names: of the values it needs, in order; None where nobody has looked yet.
        dollars: how many expressions it has, at most.
        is_odd: whether its expressions need more than simple values.
    """

    __slots__ = ("attributes", "children", "dollars", "is_odd", "names", "position", "size", "tag", "texts")

    def __init__(
        self,
        tag: str,
        attributes: dict[str, str],
        children: list[Pattern | Element],
        texts: list[tuple[int, str]],
        position: Position,
        size: int,
    ) -> None:
        self.tag, self.attributes, self.children, self.texts = tag, attributes, children, texts
        self.position, self.size = position, size
        self.names: tuple[str, ...] | None = None
        self.dollars = 0
        self.is_odd = False

    def expressions(self) -> Iterator[str]:
        """Yield the texts directly in it that hold a ``$``."""
        yield from (text for text in self.attributes.values() if "$" in text)
        yield from (text for _, text in self.texts if "$" in text)


class Shelf:
    """The elements that were made, and the chains of calls that led to them: for an editor, from look to look."""

    def __init__(self) -> None:
        self._now: dict[tuple[Any, ...], Any] = {}
        self._before: dict[tuple[Any, ...], Any] = {}

    def turn(self) -> None:
        """Begin a new look: what the last one had no use for is forgotten."""
        self._before, self._now = self._now, {}

    def get(self, key: tuple[Any, ...]) -> Any:
        """Return what is on the shelf, None where nothing is."""
        found = self._now.get(key)
        if found is None:
            found = self._before.get(key)
            if found is not None:
                self._now[key] = found
        return found

    def put(self, key: tuple[Any, ...], made: Any) -> None:
        """Put what was made on the shelf; where the key has the `id` of a chain, what was made holds the chain."""
        self._now[key] = made

    def chain(self, call: Expansion, outer: Chain) -> Chain:
        """Return a chain of calls: the same object for the same call."""
        at = call.position
        key = call.macro, at.file, at.line, at.column, id(outer)
        found = self.get(key)
        if found is None:
            found = (call, *outer), outer
            self.put(key, found)
        chain: Chain = found[0]
        return chain


class Maker:
    """Makes elements of patterns in one run of xacro.

    Args:
        evaluator: of the run.
        shelf: what earlier runs made; None where nothing is remembered.
    """

    def __init__(self, evaluator: Evaluator, shelf: Shelf | None = None) -> None:
        self._evaluator, self._shelf = evaluator, shelf
        self._pieces: dict[str, list[str]] = {}
        self._first: dict[tuple[Any, ...], Element] = {}
        self._given: set[int] = set()

    def value(self, text: str, symbols: Any) -> Any:
        """Return the value of a text; None where it needs more than simple values.

        Args:
            text: with expressions.
            symbols: the table of properties.
        """
        pieces = self._split(text)
        if len(pieces) < 2 or self._evaluator.is_exhausted:
            return None
        for piece in pieces[1::2]:
            code = self._evaluator.compile(piece)
            if code.form != "plain" or any(_known(name, symbols) is None for name in code.names):
                return None
        value = self._joined(pieces, symbols)
        if value is not None:
            self._evaluator.count(text.count("$"))
        return value

    def element(self, pattern: Pattern, symbols: Any, chain: Chain) -> Element | None:
        """Return what a pattern becomes; None where it needs more than simple values.

        Args:
            pattern: what was written.
            symbols: the table of properties.
            chain: of macro calls that led to it.
        """
        self._look(pattern)
        if pattern.is_odd or not self._evaluator.has_room(pattern.dollars):
            return None
        values: dict[str, Any] = {}
        for name in pattern.names or ():
            value = values[name] = _known(name, symbols)
            if value is None:
                return None
        try:
            made = self._made(pattern, values, chain)
        except Exception:  # whatever it is, xacro will raise it again, and it is looked into then
            return None
        if made is not None:
            self._evaluator.count(pattern.dollars)
        return made

    def finished(self, element: Element, chain: Chain) -> Element:
        """Return an element without expressions as one that macro calls led to."""
        if not chain or self._shelf is None:
            return in_chain(element, chain) if chain else element
        key = element, id(chain)
        made: Element | None = self._shelf.get(key)
        if made is None or id(made) in self._given:
            made = in_chain(element, chain)
            self._shelf.put(key, made)
        self._given.add(id(made))
        return made

    def _made(self, pattern: Pattern, values: dict[str, Any], chain: Chain) -> Element | None:
        shown = tuple([repr(values[name]) for name in pattern.names or ()])
        shelf = self._shelf
        if shelf is not None:
            key = pattern, id(chain), shown
            made: Element | None = shelf.get(key)
            if made is not None and id(made) not in self._given:
                self._given.add(id(made))
                return made
        kind = pattern, shown
        first = self._first.get(kind) if shelf is None else None
        made = self._built(pattern, values, chain) if first is None else in_chain(first, chain)
        if made is None:
            return None
        if shelf is None:
            self._first[kind] = made
        else:
            shelf.put(key, made)
            self._given.add(id(made))
        return made

    def _built(self, pattern: Pattern, values: dict[str, Any], chain: Chain) -> Element | None:
        attributes: dict[str, str] = {}
        for name, text in pattern.attributes.items():
            if "$" in text:
                value = self._joined(self._split(text), values)
                if value is None:
                    return None
                text = str(value)
            attributes[name] = text
        written = ""
        for _, text in pattern.texts:
            value = self._joined(self._split(text), values) if "$" in text else text
            if value is None:
                return None
            written += str(value)
        children: list[Element] = []
        for child in pattern.children:
            made = self._made(child, values, chain) if isinstance(child, Pattern) else self.finished(child, chain)
            if made is None:
                return None
            children.append(made)
        return Element(pattern.tag, attributes, children, written.strip(), Origin(pattern.position, chain))

    def _look(self, pattern: Pattern) -> None:
        """Find out what a pattern needs, once."""
        if pattern.names is not None:
            return
        names: dict[str, None] = {}
        for text in pattern.expressions():
            expressions = self._split(text)[1::2]
            pattern.is_odd = pattern.is_odd or not expressions
            pattern.dollars += text.count("$")
            for expression in expressions:
                try:
                    code = self._evaluator.compile(expression)
                except Exception:  # what is wrong with it is told when xacro evaluates it
                    pattern.is_odd = True
                else:
                    pattern.is_odd = pattern.is_odd or code.form != "plain"
                    names.update(dict.fromkeys(code.names))
        for child in pattern.children:
            if isinstance(child, Pattern):
                self._look(child)
                pattern.is_odd = pattern.is_odd or child.is_odd
                pattern.dollars += child.dollars
                names.update(dict.fromkeys(child.names or ()))
        pattern.names = tuple(names)

    def _joined(self, pieces: list[str], values: Any) -> Any:
        """Return the value of a text that is cut at its expressions, None where it is not simple."""
        found: list[Any] = []
        for index, piece in enumerate(pieces):
            if index % 2:
                found.append(self._evaluator.safe_eval(piece, values))
            elif piece:
                found.append(piece)
        value = found[0] if len(found) == 1 else "".join(map(str, found))
        is_simple = type(value) in _SIMPLE and (type(value) is not str or len(value) <= MAX_CHARACTERS)
        return value if is_simple else None

    def _split(self, text: str) -> list[str]:
        """Return a text cut at its expressions: these are every second; nothing where it is not as plain as that."""
        pieces = self._pieces.get(text)
        if pieces is None:
            pieces = self._pieces[text] = _cut(text)
        return pieces


def _cut(text: str) -> list[str]:
    """Return a text cut at its ``${…}``; nothing where there is another ``$``."""
    before, *others = text.split("${")
    pieces = [before]
    for other in others:
        expression, end, after = other.partition("}")
        if not end:
            return []
        pieces += expression, after
    return [] if any("$" in piece for piece in pieces) else pieces


def in_chain(element: Element, chain: Chain) -> Element:
    """Return an element, and all below it, as one that macro calls led to."""
    children = [in_chain(child, chain) for child in element.children]
    origin = Origin(element.origin.position, chain)
    return Element(element.tag, dict(element.attributes), children, element.text, origin)


def _known(name: str, table: Any) -> Any:
    """Return the simple value that a property has; None where it has none yet, or others have to look for it."""
    while hasattr(table, "parent"):
        if dict.__contains__(table, name):
            if name in table.unevaluated:
                return None
            break
        table = table.parent
    value = dict.get(table, name)
    return value if type(value) in _SIMPLE else None
