"""Reuse: a child of a root element expands to the same elements as before if all it read is the same.

While a child is evaluated, the names that it looks up outside itself and its side effects are recorded. A child
that defines names for others, includes files, warns or fails is evaluated each time.
"""

from __future__ import annotations

from collections.abc import Iterator

from urdfkit.description.xacro.evaluation.element_conversion import element_of
from urdfkit.description.xacro.evaluation.expressions.limits import MAX_EXPANDED, MAX_EXPRESSIONS, MAX_MACRO_CALLS
from urdfkit.description.xacro.evaluation.expressions.symbols import Scope
from urdfkit.description.xacro.evaluation.failures import Failure
from urdfkit.description.xacro.evaluation.macros import Calls, Macro
from urdfkit.description.xacro.evaluation.tree import CDATA, TEXT, ExpandedElements, Tag
from urdfkit.description.xacro.memory import Child, Memory, Record, Root, adopted
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.reader import MAX_MADE_DEPTH
from urdfkit.description.xml.source import Source
from urdfkit.errors import XmlError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    Steps = Iterator["Steps"]

_DIRECTIVES = frozenset(f"xacro:{name}" for name in ("macro", "property", "include", "arg", "attribute"))
"""Directives that define names for others, or include files."""

_MISSING, _GLOBAL = object(), object()


class MixedContent(Exception):  # noqa: N818 - a reason to begin again, not an error
    """The root has text between its elements; a memory does not keep the white space between elements."""


class _Holder(Tag):
    """A root element while one of its children is evaluated."""

    __slots__ = ()


class _Reads(dict[object, object]):
    """The names that are looked up; has none of them."""

    is_changed = False

    def __init__(self, scope: Scope) -> None:
        self._scope = scope
        self.names: dict[Any, None] = {}

    def __contains__(self, name: object) -> bool:
        self.names[name] = None
        return False

    def get(self, name: Any, default: Any = None) -> Any:
        self.is_changed = True
        return self._scope.values.get(name, default)

    def pop(self, name: Any, *default: Any) -> Any:
        self.is_changed = True


class _Watched(Scope):
    """Wrapper of a scope that records which names are looked up, and whether the scope is changed."""

    __slots__ = ("reads",)

    def __init__(self, scope: Scope) -> None:
        super().__init__(scope)
        self.values = self.reads = _Reads(scope)

    @property
    def outer(self) -> Any:
        return self.parent.outer  # type: ignore[union-attr]

    def set(self, name: Any, value: Any, *, is_lazy: bool) -> None:
        self.reads.is_changed = True
        self.parent.set(name, value, is_lazy=is_lazy)  # type: ignore[union-attr]


class Reuse(Calls):
    """Evaluates the files of a memory."""

    _collections: tuple[str, ...] = ("macros", "properties")
    _memory: Memory | None = None

    def _below(self, tag: Tag, macros: Scope, scope: Scope) -> Steps:
        raise NotImplementedError

    def _document(self, source: Source) -> Tag:
        tag = self.at[0]
        place = tag.parent if isinstance(tag, Tag) else None
        while place is not None and place.tag in ("xacro:if", "xacro:unless"):
            place = place.parent
        is_inside = place is not None and type(place) is not _Holder
        if self._memory is None or is_inside:
            return self._read(source)
        return self._memory.document(source, self._read, lambda: self.untraced, self._is_clean)

    def _is_clean(self, document: Tag) -> bool:
        """Return whether a tree needs no repair."""
        return True

    def _can_repeat(self) -> bool:
        """Return whether elements depend on nothing but what they read."""
        return True

    def _remembered(self, root: Root, macros: Scope, scope: Scope) -> Steps:
        """Evaluate the children of a root element, except children that expand to the same as before."""
        has_own_names = type(scope) is type(macros) is Scope  # and not those of a namespace
        can_repeat = has_own_names and self._can_repeat()
        values: dict[tuple[bool, Any], Any] = {}  # of names, until a child may change them
        repeated: list[Element] = []
        for child in root.remembered:
            if can_repeat and child.record is not None and self._holds(child.record, macros, scope, values):
                repeated += child.elements
                continue
            if repeated:
                root.append(ExpandedElements(repeated, root.position))
                repeated = []
            child.record = None
            yield self._evaluate(child, root, macros, scope, is_traced=can_repeat)
            can_repeat = has_own_names and self._can_repeat()
            values.clear()
        if repeated:
            root.append(ExpandedElements(repeated, root.position))

    def _evaluate(self, child: Child, root: Root, macros: Scope, scope: Scope, *, is_traced: bool) -> Steps:
        tag = child.tag
        holder = _Holder(root.tag, root.attributes, root.position, ())
        holder.parent = root.parent
        # The body of a macro is copied by each call; it stays the same object, which calls are known by.
        holder.append(tag if tag.tag == "xacro:macro" else tag.copy(None, _count_nothing))
        if not is_traced or tag.tag in _DIRECTIVES:
            yield self._below(holder, macros, scope)
        else:
            yield self._traced(child, holder, macros, scope)
        for node in list(holder.children()):
            if node.data and not node.data.isspace() and node.kind in (TEXT, CDATA):
                raise MixedContent
            holder.first = holder.last = None
            node.parent = node.before = node.after = None
            root.append(node)

    def _traced(self, child: Child, holder: Tag, macros: Scope, scope: Scope) -> Steps:
        watched_macros, watched = _Watched(macros), _Watched(scope)
        counts = self._counts()
        collected = {name: getattr(self, name) for name in self._collections}
        before = self.untraced, dict(holder.attributes)
        commands, self.commands.log = self.commands.log, {}
        for name, collection in collected.items():
            setattr(self, name, type(collection)())
        try:
            yield self._below(holder, watched_macros, watched)
        finally:
            log, self.commands.log = self.commands.log, commands
            added = [(name, getattr(self, name)) for name in self._collections]
            for name, more in added:
                collected[name].update(more)
                setattr(self, name, collected[name])
        is_same = before == (self.untraced, holder.attributes) and None not in log.values()
        if not is_same or watched.reads.is_changed or watched_macros.reads.is_changed:
            return
        reads = [(True, name, _current(macros, name)) for name in watched_macros.reads.names]
        reads += [(False, name, _current(scope, name)) for name in watched.reads.names]
        elements = _elements(holder)
        if elements is None or any(value is None for _, _, value in reads):
            return
        if len(elements) == len(child.elements):
            elements = list(map(adopted, elements, child.elements))
        child.elements = elements
        used = [now - then for now, then in zip(self._counts(), counts, strict=True)]
        child.record = Record(reads, log, [one for one in added if one[1]], used)
        holder.first = holder.last = None
        holder.append(ExpandedElements(elements, holder.position))

    def _holds(self, record: Record, macros: Scope, scope: Scope, values: dict[tuple[bool, Any], Any]) -> bool:
        """Return whether a record is still valid; if so, repeat the side effects of the child.

        Args:
            record: names and commands of a child at its last evaluation.
            macros: the scope of the macros.
            scope: the scope of the properties.
            values: what `_current` has returned for names, each with whether a macro was looked up; updated.
        """
        expanded, calls, evaluated, steps = record.counts
        expanded, calls, evaluated = self._expanded + expanded, self._calls + calls, self._evaluated + evaluated
        steps += self.budget.left
        if expanded > MAX_EXPANDED or calls > MAX_MACRO_CALLS or evaluated > MAX_EXPRESSIONS or steps < 0:
            return False
        for is_macro, name, value in record.reads:
            if (is_macro, name) not in values:
                values[is_macro, name] = _current(macros if is_macro else scope, name)
            if values[is_macro, name] != value:
                return False
        for content, value in record.commands.items():
            try:
                if self.commands.value(content) != value:
                    return False
            except Failure:
                return False
        self._expanded, self._calls, self._evaluated, self.budget.left = expanded, calls, evaluated, steps
        for name, more in record.collected:
            getattr(self, name).update(more)
        return True

    def _counts(self) -> list[int]:
        return [self._expanded, self._calls, self._evaluated, self.budget.left]


def _current(scope: Scope, name: Any) -> Any:
    """Return what identifies the value of a name; None if nothing does."""
    at: Any = scope
    while isinstance(at, Scope):
        if name in at.values:
            value = scope[name]
            kind = type(value)
            if kind is Macro:
                return value.body
            return (kind, repr(value)) if kind in (str, int, float, bool) else None
        at = at.parent
    return _GLOBAL if name in at else _MISSING


def _elements(holder: Tag) -> list[Element] | None:
    """Return the elements that a child expanded to; None if they are nested very deep."""
    found: list[Element] = []
    for node in holder.children():
        if type(node) is ExpandedElements:
            return None
        if isinstance(node, Tag):
            try:
                found.append(element_of(node, MAX_MADE_DEPTH // 2))
            except XmlError:
                return None
    return found


def _count_nothing(_: int) -> None:
    """Count nothing: the copied elements come from the source, not from an expansion."""
