"""Macro calls that are missing next to a call for the other side or the other copy of a part."""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.xml.source import Expansion, Span
    from urdfkit.lint.model.model import Model

_OF_NAMES = re.compile("C70[17]|J416|K959|T20[12]|Z80[1-4]")
"""Matches codes of findings on names of links and joints that do not exist."""

_SMALLEST = 2
"""Number of different findings on names of one missing call from which on the names are right."""


def with_missing_calls(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those on names that one missing macro call would define have its place as the other side.

    The place is the call that defines the same names with one different word, such as `right` instead of `left`.
    """
    lacking = [each for each in findings if _OF_NAMES.match(each.code)]
    if len(lacking) < _SMALLEST or not model.expanded.macros:
        return findings
    origins = {
        part.name: part.element.origin.expansions
        for part in model.parts
        if part.name and part.element.origin.expansions
    }
    places: dict[int, tuple[Expansion, Span]] = {}
    uses: dict[Span, set[tuple[str, Span]]] = {}
    for finding in lacking:
        found = {
            place[1]: place
            for name in undefined_names(finding, model)
            for place in _calls_of_twins(name, origins, model)
        }
        if len(found) == 1:
            place = places[id(finding)] = next(iter(found.values()))
            uses.setdefault(place[1], set()).add((finding.code, finding.span))
    changed = []
    for finding in findings:
        at = places.get(id(finding))
        if at is None or finding.other is not None or len(uses[at[1]]) < _SMALLEST:
            changed.append(finding)
            continue
        help = f"a call of macro `{at[0].macro}` with other arguments is missing here, or its name is wrong"
        details = {"other": at[1], "is_other_wrong": True, "cause": "missing call", "help": help, "fix": None}
        changed.append(Finding(**{**finding.__dict__, **details}))
    return changed


def undefined_names(finding: Finding, model: Model) -> set[str]:
    """Return the names of a finding that no link or joint has."""
    written = finding.suggestion.written if finding.suggestion is not None else ""
    named = {name for name in (finding.link, finding.joint, *finding.names, written) if name and "_" in name}
    return named - model.robot.link_by_name.keys() - model.robot.joint_by_name.keys()


def _calls_of_twins(
    name: str, origins: dict[str, tuple[Expansion, ...]], model: Model
) -> Iterator[tuple[Expansion, Span]]:
    """Yield the macro call that defines a name with one other word, and its place: the argument with that word."""
    words = name.split("_")
    inner = None
    for other, calls in origins.items():
        others = other.split("_")
        different = [at for at, word in enumerate(words) if len(others) == len(words) and others[at] != word]
        if len(different) != 1:
            continue
        for call in calls:
            tag = model.tag(call.position)
            values = {each.value for each in tag.attributes.values()} if tag is not None else set()
            if others[different[0]] in values and words[different[0]] not in values:
                yield call, model.span(call.position)
                return
        inner = inner or calls[0]
    if inner is not None:
        yield inner, model.span(inner.position)
