"""Calls of one macro whose numbers are equal although their elements must differ."""

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.description.xml.source import Position
from urdfkit.lint.finding import Finding
from urdfkit.lint.model.model import Model


def equal_call(model: Model, first: Element, other: Element) -> Position | None:
    """Return the call that produced the second of two elements, if that of the first one passes the same numbers.

    None if another macro, or none, produced one of them, or if the calls pass no number: then the macro is wrong.
    """
    chains = (reversed(first.origin.expansions), reversed(other.origin.expansions))
    different = next((pair for pair in zip(*chains, strict=False) if pair[0].position != pair[1].position), None)
    if first.origin.position != other.origin.position or different is None:
        return None
    calls = [model.tag(each.position) for each in different]
    values = [
        {name: found for name, each in call.attributes.items() if (found := number(each.value)) is not None}
        for call in calls
        if call is not None
    ]
    common = values[0].keys() & values[1].keys() if len(values) == 2 else ()
    return different[1].position if common and all(values[0][name] == values[1][name] for name in common) else None


def with_calls_of(finding: Finding, twin: Element) -> Finding:
    """Return a finding with the macro calls of a second element, which the same tag of a macro produced."""
    chain = twin.origin.expansions
    return (
        Finding(**{**finding.__dict__, "chains": tuple(dict.fromkeys((chain, *finding.chains)))}) if chain else finding
    )
