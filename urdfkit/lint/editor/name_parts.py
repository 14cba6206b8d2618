"""Parts of a name that xacro composes, such as ``${side}_wheel``, traced to the literals where they are written."""

import re

from urdfkit.description.xml.source import Expansion, Source
from urdfkit.lint.editor.symbol_occurrences import parameters_around
from urdfkit.lint.finding import Edit
from urdfkit.lint.model.model import Model
from urdfkit.lint.model.tags import Tag
from urdfkit.record import record

_PIECE = re.compile(r"\$\{\s*([A-Za-z_]\w*)\s*\}|\$[{(].*?[})]|[^$]+|\$")
_MAX_DEPTH = 20
"""Maximum number of macro calls and properties between a name and its literal."""


@record
class ComposedText:
    """A text that xacro evaluates: its file, its start offset, and the macro calls around it, innermost first."""

    source: Source
    start: int
    text: str
    calls: tuple[Expansion, ...] = ()


@record
class _NamePart:
    """One literal or expression of a text; `value` is None if it is unknown, `origin` is the text of a name."""

    start: int
    end: int
    value: str | None
    is_literal: bool
    origin: ComposedText | None = None


def edit_for(model: Model, written: ComposedText, old: str, new: str, depth: int = 0) -> Edit | None:
    """Return the edit of one literal after which a text has another value.

    A literal argument of a macro call or of a property is edited before a literal in the text itself, which concerns
    all calls of the macro.

    Args:
        model: the model.
        written: the text.
        old: its value.
        new: the value after the edit.
        depth: number of names that were followed.

    Returns:
        None if an expression computes the part that changes, or if it is written nowhere.
    """
    parts = _parts(model, written, depth)
    unknown = [index for index, part in enumerate(parts) if part.value is None]
    values = [part.value or "" for part in parts]
    if len(unknown) > 1:
        return None
    for index in unknown:  # the rest of the old value
        before, after = "".join(values[:index]), "".join(values[index + 1 :])
        if not (old.startswith(before) and old.endswith(after)):
            return None
        values[index] = old[len(before) : len(old) - len(after)]
    for index in sorted(range(len(parts)), key=lambda each: parts[each].is_literal):
        part, before, after = parts[index], "".join(values[:index]), "".join(values[index + 1 :])
        value = new[len(before) : len(new) - len(after)]
        if not (value and values[index] and before + value + after == new):
            continue
        if part.is_literal:
            return Edit(written.source.span(part.start, part.end), value)
        if part.origin is not None and (found := edit_for(model, part.origin, values[index], value, depth + 1)):
            return found
    return None


def literal_at(model: Model, tag: Tag | None, offset: int) -> tuple[int, int] | None:
    """Return start and end offset of the literal argument of a macro call, or the value of a property, at an offset."""
    if tag is None or not tag.name.startswith("xacro:"):
        return None
    plain = tag.name.removeprefix("xacro:")
    for name, attribute in tag.attributes.items():
        is_value = name == "value" if plain == "property" else plain in model.expanded.macros
        if (
            is_value
            and attribute.value_start <= offset <= attribute.value_end
            and not re.search(r"[$&]", attribute.value)
        ):
            return attribute.value_start, attribute.value_end
    return None


def _parts(model: Model, written: ComposedText, depth: int) -> list[_NamePart]:
    found = []
    for piece in _PIECE.finditer(written.text):
        start, end = written.start + piece.start(), written.start + piece.end()
        if piece[0][0] != "$":
            found.append(_NamePart(start, end, piece[0], True))
            continue
        origin = _origin(model, piece[1], written.calls) if piece[1] and depth < _MAX_DEPTH else None
        values = [part.value for part in _parts(model, origin, depth + 1)] if origin is not None else [None]
        value = None if None in values else "".join(filter(None, values))
        found.append(_NamePart(start, end, value, False, origin))
    return found


def _origin(model: Model, name: str, calls: tuple[Expansion, ...]) -> ComposedText | None:
    """Return the argument, default or property that gives a name its value."""
    if calls:
        call, source = model.tag(calls[0].position), model.document(calls[0].position.file).source
        if call is not None and (argument := call.attributes.get(name)) is not None:
            return ComposedText(source, argument.value_start, argument.value, calls[1:])
    properties = []
    for file in model.expanded.sources:
        document = model.document(file)
        for tag in document.walk():
            plain, named = tag.name.removeprefix("xacro:"), tag.attributes.get("name")
            if named is None:
                continue
            is_called = bool(calls) and plain == "macro" and named.value.removeprefix("xacro:") == calls[0].macro
            if is_called and name in (parameters := parameters_around(tag)):
                return _default(document.source, tag, parameters[name][1])
            if plain == "property" and named.value == name and (value := tag.attributes.get("value")) is not None:
                inside = any(outer.name.removeprefix("xacro:") == "macro" for outer in tag.ancestors())
                around = calls if inside else ()
                properties.append(ComposedText(document.source, value.value_start, value.value, around))
    return properties[0] if len(properties) == 1 else None


def _default(source: Source, macro: Tag, end: int) -> ComposedText | None:
    """Return the default of the parameter whose name ends at an offset."""
    pattern = r"\s*:?=\s*(?:'(?P<quoted>[^'^$]*)'|(?P<plain>[^\s'\"^$]+)(?=[\s\"']|$))"
    found = re.compile(pattern).match(source.text, end, macro.end)
    group = "quoted" if found is not None and found["quoted"] is not None else "plain"
    return ComposedText(source, found.start(group), found[group]) if found is not None else None
