"""Rename symbols, in every file that names them.

Links, joints and materials are renamed by trial: the edits are applied in memory, the robot is expanded again, and the
names that changed, or that should have changed, lead to further edits. So names that a macro composes follow the
literal in its call, and an edit that would change anything but names is refused.
"""

from __future__ import annotations

import re
from pathlib import Path

from urdfkit.errors import UsageError
from urdfkit.lint.editor.launch_occurrences import in_launch_files
from urdfkit.lint.editor.name_parts import ComposedText, edit_for, literal_at
from urdfkit.lint.editor.navigation import at, of_parameter, parameter_at
from urdfkit.lint.editor.rviz_occurrences import in_rviz_files
from urdfkit.lint.editor.srdf_occurrences import in_srdf_files
from urdfkit.lint.editor.symbol_occurrences import (
    EXPANDED,
    expanded_occurrences,
    in_settings,
    of_model,
    parameters_around,
)
from urdfkit.lint.finding import Edit

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Mapping, Sequence

    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Span
    from urdfkit.lint.editor.cursor import Cursor
    from urdfkit.lint.editor.symbol_occurrences import Occurrence
    from urdfkit.lint.model.model import Model
    from urdfkit.lint.model.tags import Tag

    Expand = Callable[[Model, Mapping[str, str]], Model]
    """Expands a model again, with other texts of some files."""

_NAME = r"[A-Za-z_]\w*"
_EXPANDED_NAME = r"[^\s\"'<>&$]+"
_MAX_ROUNDS = 20
_NAMING = frozenset(("name", "reference", "link", "joint"))
"""Attributes that an edit of a name may change."""


def renamable(model: Model, cursor: Cursor) -> tuple[Span, str] | None:
    """Return the text under the cursor that can be renamed, and the name that it stands for; None without one."""
    source = cursor.document.source
    if parameter_at(cursor) is not None:
        word, start = cursor.word
        word = word.partition(".")[0]
        return source.span(start, start + len(word)), word
    if (place := literal_at(model, cursor.tag, cursor.offset)) is not None:
        value = source.text[slice(*place)]
        position = source.position(cursor.tag.start) if cursor.tag is not None else None
        is_property = cursor.tag is not None and cursor.tag.name == "xacro:property"
        for one in expanded_occurrences(model):
            called = is_property or any(call.position == position for call in one.calls)
            if value and called and value in one.name and one.written != one.name:
                return source.span(*place), value
    symbol = _symbol(model, cursor)
    return (symbol.span, symbol.name) if symbol is not None else None


def rename(models: Sequence[Model], cursor: Cursor, name: str, expand: Expand) -> list[Edit]:
    """Return the edits that rename the symbol under the cursor in all files.

    Args:
        models: the models that the file belongs to.
        cursor: the place of the symbol.
        name: the new name.
        expand: expands a model again, with other texts.

    Raises:
        UsageError: the symbol has no name, the new name is invalid or in use, or an expression computes the name.
    """
    if (parameter := parameter_at(cursor)) is not None:
        return _rename_parameter(models, cursor, parameter, name, expand)
    found = renamable(models[0], cursor)
    if found is None:
        raise UsageError("nothing to rename here: this is not a symbol, or an expression computes its name")
    place = literal_at(models[0], cursor.tag, cursor.offset)
    if place is not None and found[0] == cursor.document.source.span(*place):
        _check(name, _EXPANDED_NAME, "link, joint or material")
        return _Trial(models, expand, {}, {found[0]: name}).edits()
    wanted: dict[tuple[str, str], str] = {}
    edits: dict[Edit, None] = {}
    for model in models:
        one = _symbol(model, cursor)
        if one is None:
            raise UsageError("nothing to rename here: this is not a symbol, or an expression computes its name")
        _check(name, _EXPANDED_NAME if one.kind in EXPANDED else _NAME, one.kind)
        every = of_model(model)
        if any(other.defines and (other.kind, other.name) == (one.kind, name) for other in every):
            raise UsageError(f"{one.kind} `{name}` already exists")
        if one.kind == "property" and _is_parameter(model, one.name):
            raise UsageError(f"`{one.name}` is the parameter of a macro too: rename it manually")
        same = [other for other in every if (other.kind, other.name) == (one.kind, one.name)]
        if not any(other.defines for other in same):
            raise UsageError(f"{one.kind} `{one.name}` is not defined in these files")
        if one.kind in EXPANDED:
            wanted[one.kind, one.name] = name
            continue
        launched = (other for other in in_launch_files(model) if (other.kind, other.name) == (one.kind, one.name))
        edits.update((Edit(other.span, name), None) for other in (*same, *launched))
    return sorted(edits) if not wanted else _Trial(models, expand, wanted, {}).edits()


def _symbol(model: Model, cursor: Cursor) -> Occurrence | None:
    found = [one for one in at(model, cursor) if one.kind != "file"]
    return found[0] if len({(one.kind, one.name) for one in found}) == 1 else None


def _check(name: str, pattern: str, kind: str) -> None:
    if not re.fullmatch(pattern, name):
        raise UsageError(f"`{name}` is not a valid name for a {kind}")


def _is_parameter(model: Model, name: str) -> bool:
    found = (signature for several in model.signatures.values() for signature in several)
    return any(name in signature.names for signature in found)


def _rename_parameter(
    models: Sequence[Model], cursor: Cursor, parameter: tuple[str, Tag], name: str, expand: Expand
) -> list[Edit]:
    _check(name, _NAME, "parameter")
    old, macro = parameter
    if name in parameters_around(macro):
        raise UsageError(f"parameter `{name}` already exists")
    spans = dict.fromkeys(of_parameter(models, cursor, old, macro, with_definition=True), name)
    for model in models:
        after = expand(model, _texts(models, spans))
        if _outline(model) != _outline(after):
            raise UsageError(f"renaming the parameter `{old}` to `{name}` changes the robot: rename it manually")
    return sorted(Edit(span, name) for span in spans)


def _outline(model: Model) -> list[tuple[str, dict[str, str], str]]:
    root = model.expanded.root
    return [(one.tag, dict(one.attributes), one.text) for one in root.walk()] if root is not None else []


def _texts(models: Sequence[Model], edits: Mapping[Span, str]) -> dict[str, str]:
    """Return absolute path → text of the files after the edits."""
    sources = {name: source for model in models for name, source in model.expanded.sources.items()}
    found: dict[str, str] = {}
    for span in sorted(edits, reverse=True):
        source, path = sources[span.file], str(Path.cwd() / span.file)
        start, end = source.offset(span.line, span.column), source.offset(span.end_line, span.end_column)
        text = found.get(path, source.text)
        found[path] = text[:start] + edits[span] + text[end:]
    return found


class _Trial:
    """Edits that are extended until all names of the expanded robots are as required.

    Args:
        models: the models before.
        expand: expands a model again.
        wanted: kind and name of symbols → new name.
        written: span → text of the first edits, whose effect on names counts as required.
    """

    def __init__(
        self, models: Sequence[Model], expand: Expand, wanted: dict[tuple[str, str], str], written: dict[Span, str]
    ) -> None:
        self._models, self._expand, self._written = models, expand, written
        self._before = [list(expanded_occurrences(model)) for model in models]
        self._names = [dict(wanted) for _ in models]
        self._adopts = bool(written)

    def edits(self) -> list[Edit]:
        """Return the edits.

        Raises:
            UsageError: an expression computes a name, or the edits change more than names.
        """
        for _ in range(_MAX_ROUNDS):
            texts = _texts(self._models, self._written)
            sizes = self._sizes()
            for index, model in enumerate(self._models):
                after = self._expand(model, texts) if texts else model
                self._compare(index, after)
            self._adopts = False
            if sizes == self._sizes():
                break
        if not any(self._names):
            raise UsageError("nothing to rename here: no link, joint or material is named with this text")
        found = dict(self._written)
        for model, names in zip(self._models, self._names, strict=True):
            for other in _elsewhere(model):
                if (new := names.get((other.kind, other.name))) is not None:
                    found[other.span] = new
        return sorted(Edit(span, text) for span, text in found.items())

    def _sizes(self) -> list[int]:
        return [len(self._written), *map(len, self._names)]

    def _compare(self, index: int, after: Model) -> None:
        model, names = self._models[index], self._names[index]
        if (before_root := model.expanded.root) is not None and (after_root := after.expanded.root) is not None:
            _check_structure(before_root, after_root)
        pairs = list(zip(self._before[index], expanded_occurrences(after), strict=True))  # of equal structure
        defined = {(old.kind, old.name) for old, _ in pairs if old.defines}
        for old, new in sorted(pairs, key=lambda pair: not pair[0].defines):
            key = (old.kind, old.name)
            if new.name == names.get(key, old.name):
                continue
            if key not in names and (old.defines or self._adopts or key not in defined):
                names[key] = new.name
            else:
                self._correct(model, old, names.get(key, old.name))
        kinds = {(old.kind, new.name): old.name for old, new in pairs if old.defines}
        for old, new in pairs:
            if old.defines and kinds[old.kind, new.name] != old.name:
                raise UsageError(f"{old.kind} `{new.name}` already exists")

    def _correct(self, model: Model, one: Occurrence, name: str) -> None:
        source = model.document(one.span.file).source
        start = source.offset(one.span.line, one.span.column)
        edit = edit_for(model, ComposedText(source, start, one.written, one.calls), one.name, name)
        if edit is None or self._written.setdefault(edit.span, edit.text) != edit.text:
            at = f"{one.span.file}:{one.span.line}"
            raise UsageError(f"`{one.name}` is computed by the expression `{one.written}` at {at}: rename it manually")


def _elsewhere(model: Model) -> Iterator[Occurrence]:
    """Yield the occurrences of names outside of the description."""
    for search in (in_settings, in_launch_files, in_srdf_files, in_rviz_files):
        yield from search(model)


def _check_structure(before: Element, after: Element) -> None:
    """Raise an error unless two robots differ in names alone."""
    pending = [(before, after)]
    while pending:
        old, new = pending.pop()
        at = f"{old.origin.position.file}:{old.origin.position.line}"
        if (old.tag, len(old.children)) != (
            new.tag,
            len(new.children),
        ) or old.attributes.keys() != new.attributes.keys():
            raise UsageError(f"an expression in <{old.tag}> at {at} depends on the name: rename it manually")
        for name, value in old.attributes.items():
            if value != new.attributes[name] and name not in _NAMING:
                raise UsageError(f"`{name}` of <{old.tag}> at {at} depends on the name: rename it manually")
        pending += zip(old.children, new.children, strict=True)
