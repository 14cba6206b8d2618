"""Values of macro calls and properties that give many links and joints another name than their uses."""

from __future__ import annotations

import re

from urdfkit.errors import nearest
from urdfkit.lint.facts.root_cause import value_of
from urdfkit.lint.facts.values.missing_calls import undefined_names
from urdfkit.lint.facts.values.renamed_definitions import RenamedDefinitions
from urdfkit.lint.finding import Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from urdfkit.description.xml.element import Element
    from urdfkit.lint.facts.root_cause import Place
    from urdfkit.lint.model.model import Model

    Patterns = dict[str, re.Pattern[str]]

_OF_NAMES = re.compile("C70[17]|J416|K959|M10[48]|T20[12]|Z80[1-4]")
"""Matches codes of findings on names of links and joints that do not exist."""

_SMALLEST = 2
"""Number of undefined names that differ from the defined ones by one value from which on that value is wrong."""

_MOST_STEPS = 8
"""Number of macro calls and properties that hand on a value, at most."""

_EXPRESSION = re.compile(r"\$\{[^{}]*\}|\$\([^()]*\)")
_NAME = re.compile(r"\$\{\s*([A-Za-z_]\w*)\s*\}")


def at_renaming_arguments(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those on names that one other value would define have that value as the other side.

    The value is an argument of a macro call or a property, such as `right` instead of `right_`. All undefined names
    differ from defined names by the same part, and no other place uses any name that the value is a part of.
    """
    lacking = [each for each in findings if _OF_NAMES.match(each.code) and each.other is None]
    undefined = {id(each): undefined_names(each, model) for each in lacking}
    names = {name for each in undefined.values() for name in each}
    if len(names) < _SMALLEST:
        return findings
    best: list[tuple[Place, str, str, set[str]]] = []
    for place, (value, patterns) in _patterns(model).items():
        meant, renamed = _most_common(names, patterns.values())
        if len(renamed) >= _SMALLEST and _is_like(value, meant) and not _is_used(place, patterns, model):
            best.append((place, value, meant, renamed))
    best.sort(key=lambda each: -len(each[3]))
    if not best or (len(best) > 1 and len(best[1][3]) == len(best[0][3])):
        return findings
    (at, attribute), value, meant, renamed = best[0]
    example = min(renamed)
    message = (
        f'no other place uses names with {attribute}="{value}"; did you mean "{meant}", '
        f"as in `{example}`, which is used but undefined?"
    )
    details = {"other": model.span(at, attribute), "is_other_wrong": True, "cause": "argument", "message": message}
    details.update(help=None, link=None, joint=None)
    return [
        Finding(**{**each.__dict__, **details}) if not renamed.isdisjoint(undefined.get(id(each), ())) else each
        for each in findings
    ]


def _patterns(model: Model) -> dict[Place, tuple[str, Patterns]]:
    """Return for each literal value in names of links and joints the value, and a pattern for each of the names.

    The pattern matches the name with any other value, which is its first group.
    """
    found: dict[Place, tuple[str, Patterns]] = {}
    for part in model.parts:
        for place, value, pattern in _values(part.element, "name", part.name, model):
            found.setdefault(place, (value, {}))[1][part.name] = pattern
    return found


def _values(element: Element, attribute: str, text: str, model: Model) -> Iterator[tuple[Place, str, re.Pattern[str]]]:
    """Yield the place of each literal value that an attribute consists of, the value and the pattern for others."""
    tag = model.tag(element.origin.position)
    written = tag.attributes.get(attribute) if tag is not None else None
    if written is None or "${" not in written.value:
        return
    constants = _EXPRESSION.split(written.value)
    values = [_value(each, element, model) for each in _EXPRESSION.findall(written.value)]
    inserted = [f"({re.escape(each[1])})" if each is not None else "(.*?)" for each in values]
    whole = re.fullmatch(_joined(constants, inserted), text)
    if whole is None:
        return
    for at, each in enumerate(values):
        if each is not None:
            others = [re.escape(group) for group in whole.groups()]
            others[at] = r"([\w.-]*)"
            yield *each, re.compile(_joined(constants, others))


def _joined(constants: Sequence[str], inserted: Iterable[str]) -> str:
    """Return the pattern for constants with other patterns between them."""
    parts = zip(constants, (*inserted, ""), strict=True)
    return "".join(re.escape(constant) + other for constant, other in parts)


def _value(expression: str, element: Element, model: Model) -> tuple[Place, str] | None:
    """Return the place and the text of the literal value that an expression names; None if it is computed."""
    text, place, calls = expression, None, element.origin.expansions
    for _ in range(_MOST_STEPS):  # a property may name itself
        alone = _NAME.fullmatch(text)
        if alone is None:
            break
        text, place, outer = value_of(model, alone[1], calls)
        calls = tuple(outer)
    return (place, text) if place is not None and "$" not in text else None


def _most_common(names: Iterable[str], patterns: Iterable[re.Pattern[str]]) -> tuple[str, set[str]]:
    """Return the value that most undefined names have in place of the defined one, and these names."""
    found: dict[str, set[str]] = {}
    for pattern in patterns:
        for name in names:
            match = pattern.fullmatch(name)
            if match is not None:
                found.setdefault(match[1], set()).add(name)
    return max(found.items(), key=lambda each: (len(each[1]), each[0]), default=("", set()))


def _is_like(value: str, meant: str) -> bool:
    """Return whether one value may be a slip of the other: `right` and `right_`, or an empty one."""
    return not value or not meant or value.strip("_") == meant.strip("_") or nearest(value, [meant]) is not None


def _is_used(place: Place, patterns: Patterns, model: Model) -> bool:
    """Return whether any place uses a name that a value is a part of, except places that have the name from it."""
    own: dict[str, set[tuple[str, int]]] = {}
    for element in model.robot.element.walk():
        for attribute, text in element.attributes.items():
            if text in patterns and any(at == place for at, _, _ in _values(element, attribute, text, model)):
                position = element.origin.position
                own.setdefault(text, set()).add((position.file, position.line))
    definitions = RenamedDefinitions(model)
    return any(definitions.places(name) - own.get(name, set()) for name in patterns)
