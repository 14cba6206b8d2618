"""Where a defect that shows in many places was made: a file that is broken, a property, an argument of a call."""

from __future__ import annotations

import re

from urdfkit.description.xml.numbers import number

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Expansion, Position
    from urdfkit.lint.model.model import Model

    Place = tuple[Position, str]
    """A start tag, and an attribute of it."""

_EXPRESSION = r"\$\{([^{}]*)\}"
_NAME = r"(?<![\w.'\"])[A-Za-z_]\w*(?!\w|\s*\()"
_SIZE = r"(?i)radius|diameter|length|width|height|depth|size|thick"
_MAX_STEPS = 8


def is_in_broken_file(model: Model, tag: str, name: str) -> bool:
    """Whether a file that is no XML, which is a finding of its own, defines a macro or material of a name.

    Args:
        model: what is being linted.
        tag: ``macro`` or ``material``.
        name: of it.
    """
    files = {fault.position.file for fault in model.expanded.faults if fault.kind == "xml"}
    pattern = rf"<(?:xacro:)?{tag}\s[^<>]*?\bname\s*=\s*[\"'](?:xacro:)?{re.escape(name)}[\"']"
    texts = (source.text for file, source in model.expanded.sources.items() if file in files)
    return any(re.search(pattern, text) for text in texts)


def blamed(model: Model, element: Element, attribute: str, is_wrong: Callable[[str], bool]) -> Place | None:
    """Return the one property, or argument of a call, that brings a wrong value into an attribute.

    Args:
        model: what is being linted.
        element: after expansion.
        attribute: of the element.
        is_wrong: tells of a text that stands for a property or argument whether it is what is wrong.

    Returns:
        None where the value is written in the attribute itself, or where it is not clear what brings it.
    """
    tag = model.tag(element.origin.position)
    written = tag.attributes.get(attribute) if tag is not None else None
    return culprit(model, written.value, element.origin.expansions, is_wrong) if written is not None else None


def call_of(element: Element, right: Iterable[Element]) -> Position | None:
    """Return the call of a macro that makes an element wrong, where other calls make it right; None where none does.

    Args:
        element: what is wrong, after expansion.
        right: such elements that are right.
    """
    others = [one.origin for one in right if one.origin.position == element.origin.position]
    if not others:
        return None
    return next(
        (call.position for call in element.origin.expansions if not any(call in other.expansions for other in others)),
        None,
    )


def culprit(
    model: Model, text: str, calls: Sequence[Expansion], is_wrong: Callable[[str], bool], steps: int = 0
) -> Place | None:
    """Return where the one wrong value that a text with ``${…}`` uses is written; None where that is not clear.

    Args:
        model: what is being linted.
        text: as written.
        calls: the macro calls that the text went through, innermost first.
        is_wrong: as of `blamed`.
        steps: how many properties and arguments have been followed.
    """
    if steps > _MAX_STEPS:
        return None
    names = {name for inside in re.findall(_EXPRESSION, text) for name in re.findall(_NAME, inside)}
    found: dict[Place, str] = {}
    for name in names:
        value, place, outer = _value(model, name, calls)
        if place is None:
            continue
        if "${" in value:
            deeper = culprit(model, value, outer, is_wrong, steps + 1)
            if deeper is not None:
                found[deeper] = name
        elif is_wrong(value):
            found[place] = name
    if len(found) > 1 and is_wrong is is_not_positive:  # A place may well be below zero.
        found = {place: name for place, name in found.items() if re.search(_SIZE, name)}
    return next(iter(found)) if len(found) == 1 else None


def _value(model: Model, name: str, calls: Sequence[Expansion]) -> tuple[str, Place | None, Sequence[Expansion]]:
    """Return what a name stands for, as written, where, and the calls that this went through."""
    macro = model.expanded.macros.get(calls[0].macro) if calls else None
    if macro is not None and name in macro.parameters:
        call = model.tag(calls[0].position)
        given = call.attributes.get(name) if call is not None else None
        return (given.value, (calls[0].position, name), calls[1:]) if given is not None else ("", None, ())
    position = model.expanded.properties.get(name)
    tag = model.tag(position) if position is not None else None
    value = tag.attributes.get("value") if tag is not None else None
    if tag is None or value is None or position is None:
        return "", None, ()
    is_local = any(above.name in ("xacro:macro", "macro") for above in tag.ancestors())
    return value.value, (position, "value"), calls if is_local else ()


def is_not_positive(text: str) -> bool:
    """Whether a text is a number that is zero or less."""
    value = number(text.strip())
    return value is not None and value <= 0.0


def is_no_number(text: str) -> bool:
    """Whether a text that looks like a number is none: ``O.4``, ``0,4``."""
    return number(text.strip()) is None and re.fullmatch(r"\s*[-+]?[\dOol.,][\dOolIeE.,+-]*\s*", text) is not None
