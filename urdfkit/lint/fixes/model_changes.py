"""Compare the expanded model before and after fixes: elements may change only where the findings name them.

A finding names an element if a fix edits its source tag or a call of the macro that produced it. An edit in a macro
changes every expansion; the finding has to be about each of them. An edit of a property, an argument or a macro's
parameters names the elements whose source has an expression.
"""

from collections.abc import Iterator, Mapping, Sequence
from difflib import SequenceMatcher

from urdfkit.description.xacro.expanded import Expanded
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position, Source
from urdfkit.lint.finding import Edit, Finding
from urdfkit.lint.model.tags import Document, Tag

_MAX_DEPTH = 50
_DIRECTIVES = ("property", "arg", "macro", "if", "unless", "include")


def unnamed_changes(before: Expanded, after: Expanded, findings: Sequence[Finding]) -> list[Element]:
    """Return the elements that changed or disappeared without being named by a finding; in document order.

    After errors of the expansion, the model before is incomplete and nothing is compared.

    Args:
        before: the model without the fixes.
        after: the model with the fixes.
        findings: the findings that were fixed, with positions in the sources before.
    """
    if before.root is None or after.root is None or before.faults:
        return []
    places = _Places(before.sources, findings)
    return [element for element in _changed(before.root, after.root, 0) if not places.names(element)]


def _changed(old: Element, new: Element, depth: int) -> Iterator[Element]:
    """Yield the elements of the old tree that differ from those of the new tree, without their children."""
    if (old.tag, old.text, old.attributes) != (new.tag, new.text, new.attributes):
        yield old
    if depth > _MAX_DEPTH:
        return
    keys, others = ([(child.tag, child.get("name")) for child in parent.children] for parent in (old, new))
    pairs = [(0, len(keys), 0, len(others))]
    if keys != others:
        matches = SequenceMatcher(None, keys, others, autojunk=False).get_opcodes()
        pairs = [(a, b, c, d) for _, a, b, c, d in matches]
    for a, b, c, d in pairs:
        if b - a == d - c:
            for child, other in zip(old.children[a:b], new.children[c:d], strict=True):
                yield from _changed(child, other, depth + 1)
        else:
            yield from old.children[a:b]


class _Places:
    """The source places that the fixes of findings edit."""

    def __init__(self, sources: Mapping[str, Source], findings: Sequence[Finding]) -> None:
        self._sources = sources
        self._documents: dict[str, Document] = {}
        self._edits: dict[str, list[tuple[int, int, Finding]]] = {}
        self._changes_expressions = False
        for finding in findings:
            for edit in finding.fix.edits if finding.fix is not None else ():
                if edit.span.file in sources:
                    self._add(edit, finding)

    def _add(self, edit: Edit, finding: Finding) -> None:
        source, span = self._sources[edit.span.file], edit.span
        start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
        self._edits.setdefault(edit.span.file, []).append((start, end, finding))
        tag = self._around(edit.span.file, start)
        while tag is not None:
            name = tag.name.rpartition(":")[2]
            is_in_start = tag.start <= start <= tag.end
            if name in _DIRECTIVES and (is_in_start or name in ("property", "if", "unless")):
                self._changes_expressions = True
            if tag.parent is None and is_in_start:  # the root: a namespace
                self._changes_expressions = True
            tag = tag.parent

    def _document(self, file: str) -> Document:
        if file not in self._documents:
            self._documents[file] = Document(self._sources[file])
        return self._documents[file]

    def _around(self, file: str, offset: int) -> Tag | None:
        """Return the innermost element around an offset."""
        found = None
        for tag in self._document(file).walk():
            if tag.start > offset:
                break
            if offset <= max(tag.end, tag.close_end or 0):
                found = tag
        return found

    def _tag(self, position: Position) -> Tag | None:
        return self._document(position.file).tag_at(position.line, position.column)

    def names(self, element: Element) -> bool:
        """Return whether the findings name an element of the model before."""
        origin = element.origin
        if origin.position.file not in self._sources:
            return True
        for finding in self._at(origin.position):
            if not origin.expansions or not finding.chains or origin.expansions in finding.chains:
                return True
        if any(True for call in origin.expansions for _ in self._at(call.position)):
            return True
        tag = self._tag(origin.position) if self._changes_expressions else None
        return tag is not None and "$" in self._sources[origin.position.file].text[tag.start : tag.close_end or tag.end]

    def _at(self, position: Position) -> Iterator[Finding]:
        """Yield the findings whose fixes edit the element at a position, or the tags of an element around it."""
        edits = self._edits.get(position.file, ())
        tag = self._tag(position) if edits else None
        if tag is None:
            return
        spans = [(tag.start, max(tag.end, tag.close_end or 0))]
        while (parent := tag.parent) is not None and parent.parent is not None:
            spans += [(parent.start, parent.end), (parent.close or parent.end, parent.close_end or parent.end)]
            tag = parent
        for start, end, finding in edits:
            if any(start <= last and first <= end for first, last in spans):
                yield finding
