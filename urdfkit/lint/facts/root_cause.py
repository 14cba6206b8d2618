"""Root cause of a defect with many symptoms: a malformed file, a property, an argument of a macro call."""

from __future__ import annotations

import re

from urdfkit.description.xml.numbers import number

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from urdfkit.description.urdf.robot import Joint
    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Expansion, Position, Span
    from urdfkit.lint.model.model import Model

Place = tuple["Position", str]
"""A start tag, and an attribute of it."""

_EXPRESSION = r"\$\{([^{}]*)\}"
_NAME = r"(?<![\w.'\"])[A-Za-z_]\w*(?!\w|\s*\()"
_SIZE = r"(?i)radius|diameter|length|width|height|depth|size|thick"
_MAX_STEPS = 8


def is_in_broken_file(model: Model, tag: str, name: str) -> bool:
    """Return whether a malformed file, which is reported separately, defines a macro or material of that name.

    Args:
        model: the linted model.
        tag: ``macro`` or ``material``.
        name: name of the macro or material.
    """
    files = {fault.position.file for fault in model.expanded.faults if fault.kind == "xml"}
    pattern = rf"<(?:xacro:)?{tag}\s[^<>]*?\bname\s*=\s*[\"'](?:xacro:)?{re.escape(name)}[\"']"
    texts = (source.text for file, source in model.expanded.sources.items() if file in files)
    return any(re.search(pattern, text) for text in texts)


def root_cause(model: Model, element: Element, attribute: str, is_wrong: Callable[[str], bool]) -> Place | None:
    """Return the single property or macro argument that causes a wrong attribute value.

    Args:
        model: the linted model.
        element: an expanded element.
        attribute: name of the attribute.
        is_wrong: returns whether the text of a property or argument is wrong.

    Returns:
        None if the value is a literal in the attribute itself, or if the cause is ambiguous.
    """
    tag = model.tag(element.origin.position)
    written = tag.attributes.get(attribute) if tag is not None else None
    return cause_in_text(model, written.value, element.origin.expansions, is_wrong) if written is not None else None


def call_of(element: Element, right: Iterable[Element]) -> Position | None:
    """Return the macro call that produces a wrong element while other calls produce correct ones; None if not found.

    Args:
        element: the wrong expanded element.
        right: correct elements of the same kind.
    """
    others = [one.origin for one in right if one.origin.position == element.origin.position]
    if not others:
        return None
    return next(
        (call.position for call in element.origin.expansions if not any(call in other.expansions for other in others)),
        None,
    )


def shared_argument(model: Model, element: Element, other: Element) -> Place | None:
    """Return the argument of a macro call whose value another call of the macro repeats; None if any number differs.

    Args:
        model: the linted model.
        element: an element that a macro produced, whose ``xyz`` uses arguments of the macro.
        other: the same element, produced by another call.
    """
    calls, others = element.origin.expansions, other.origin.expansions
    tag = model.tag(element.origin.position) if calls and element.origin.position == other.origin.position else None
    macro = model.expanded.macros.get(calls[0].macro) if tag is not None else None
    if tag is None or macro is None or len(calls) != len(others):
        return None
    written = tag.attributes.get("xyz")
    used = {name for inside in re.findall(_EXPRESSION, written.value if written else "") for name in _names(inside)}
    found = None
    for name in macro.parameters:
        values = [value_of(model, name, each) for each in (calls, others)]
        numbers = [number(value.strip()) for value, _, _ in values]
        if numbers[0] != numbers[1] and (name in used or None not in numbers):
            return None
        if name in used and (numbers[0] is not None or values[0][0] == values[1][0]):
            found = values[0][1]
    return found


def argument_of_coordinate(model: Model, element: Element, other: Element, k: int) -> Place | None:
    """Return the argument of a macro call that alone determines a coordinate in ``xyz``; None if it is ambiguous.

    Args:
        model: the linted model.
        element: an element that a macro produced.
        other: the same element, produced by another call.
        k: index of the coordinate.
    """
    calls, others = element.origin.expansions, other.origin.expansions
    tag = model.tag(element.origin.position)
    macro = model.expanded.macros.get(calls[0].macro) if calls else None
    written = tag.attributes.get("xyz") if tag is not None else None
    parts = re.findall(r"(?:\$\{[^{}]*\}|[^\s$])+", written.value) if written is not None else []
    if macro is None or len(parts) != 3 or calls[0] in others:
        return None
    used = {name for inside in re.findall(_EXPRESSION, parts[k]) for name in _names(inside)}
    places = [value_of(model, name, calls)[1] for name in macro.parameters if name in used]
    return places[0] if len(places) == 1 else None


def _names(expression: str) -> list[str]:
    return re.findall(_NAME, expression)


def cause_in_text(
    model: Model, text: str, calls: Sequence[Expansion], is_wrong: Callable[[str], bool], steps: int = 0
) -> Place | None:
    """Return the position of the single wrong value used by a text with ``${…}``; None if it is ambiguous.

    Args:
        model: the linted model.
        text: the source text.
        calls: the macro calls around the text, innermost first.
        is_wrong: see `root_cause`.
        steps: number of properties and arguments followed so far.
    """
    if steps > _MAX_STEPS:
        return None
    names = {name for inside in re.findall(_EXPRESSION, text) for name in _names(inside)}
    found: dict[Place, str] = {}
    for name in names:
        value, place, outer = value_of(model, name, calls)
        if place is None:
            continue
        if "${" in value:
            deeper = cause_in_text(model, value, outer, is_wrong, steps + 1)
            if deeper is not None:
                found[deeper] = name
        elif is_wrong(value):
            found[place] = name
    if len(found) > 1 and is_wrong is is_not_positive:  # A coordinate may be negative.
        found = {place: name for place, name in found.items() if re.search(_SIZE, name)}
    return next(iter(found)) if len(found) == 1 else None


def value_of(model: Model, name: str, calls: Sequence[Expansion]) -> tuple[str, Place | None, Sequence[Expansion]]:
    """Return the source text that a name stands for, its position, and the macro calls around it."""
    macro = model.expanded.macros.get(calls[0].macro) if calls else None
    if macro is not None and name in macro.parameters:
        call = model.tag(calls[0].position)
        argument = call.attributes.get(name) if call is not None else None
        return (argument.value, (calls[0].position, name), calls[1:]) if argument is not None else ("", None, ())
    position = model.expanded.properties.get(name)
    tag = model.tag(position) if position is not None else None
    value = tag.attributes.get("value") if tag is not None else None
    if tag is None or value is None or position is None:
        return "", None, ()
    is_local = any(above.name in ("xacro:macro", "macro") for above in tag.ancestors())
    return value.value, (position, "value"), calls if is_local else ()


def written_at(model: Model, element: Element | None, attribute: str) -> Span | None:
    """Return the place of an attribute, or of the argument or property that a macro uses alone for it."""
    tag = model.tag(element.origin.position) if element is not None else None
    written = tag.attributes.get(attribute) if tag is not None else None
    if element is None or written is None:
        return None
    return _handed_on(model, (element.origin.position, attribute), written.value, element.origin.expansions)


def written_at_call(model: Model, place: Place, calls: Sequence[Expansion]) -> Span:
    """Return the place of an argument of a macro call, or of the argument or property that it hands on.

    Args:
        model: the linted model.
        place: the argument.
        calls: the macro calls around the call, innermost first.
    """
    tag = model.tag(place[0])
    return _handed_on(model, place, tag.attributes[place[1]].value if tag is not None else "", calls)


def _handed_on(model: Model, place: Place, text: str, calls: Sequence[Expansion]) -> Span:
    while (alone := re.fullmatch(r"\s*\$\{\s*([A-Za-z_]\w*)\s*\}\s*", text)) is not None:
        text, deeper, outer = value_of(model, alone[1], calls)
        if deeper is None:
            break
        place, calls = deeper, outer
    return model.span(*place)


def property_of_length(model: Model, length: float) -> Span | None:
    """Return the value of the only used property that is a length, or half or twice of it; None if it is ambiguous."""
    found = []
    texts = [source.text for source in model.expanded.sources.values()]
    for name, position in model.expanded.properties.items():
        value, place, _ = value_of(model, name, ())
        size = number(value.strip()) if place is not None else None
        is_length = size is not None and any(abs(size - factor * length) < _EQUAL for factor in (0.5, 1.0, 2.0))
        if is_length and any(name in _names(inside) for text in texts for inside in re.findall(_EXPRESSION, text)):
            found.append(model.span(position, "value"))
    return found[0] if len(found) == 1 else None


_EQUAL = 1e-6
"""Lengths that differ by less are equal [m]."""


def parent_at(model: Model, joint: Joint | None) -> Span | None:
    """Return the place where the parent of a joint is written."""
    return written_at(model, joint.element.find("parent"), "link") if joint is not None else None


def type_at(model: Model, joint: Joint) -> tuple[Span | None, bool]:
    """Return the place of the type of a fixed joint that is moved, and whether its limits contradict the type too."""
    has_limits = joint.limit is not None and joint.limit.lower != joint.limit.upper
    return written_at(model, joint.element, "type"), has_limits


def is_not_positive(text: str) -> bool:
    """Return whether a text is a number that is not positive."""
    value = number(text.strip())
    return value is not None and value <= 0.0


def is_no_number(text: str) -> bool:
    """Return whether a text resembles a number but is invalid: ``O.4``, ``0,4``."""
    return number(text.strip()) is None and re.fullmatch(r"\s*[-+]?[\dOol.,][\dOolIeE.,+-]*\s*", text) is not None
