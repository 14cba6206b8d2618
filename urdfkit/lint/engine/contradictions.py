"""Contradictions, at the side that is to be edited: a dependency in package.xml, a joint that ten places contradict."""

from __future__ import annotations

from urdfkit.lint.finding import SEVERITIES, Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from urdfkit.description.xml.source import Span

_SMALLEST = 2
"""Number of different findings that contradict one place, from which on that place is the wrong one."""


def at_wrong_side(findings: list[Finding]) -> list[Finding]:
    """Return the findings; those on a contradiction are moved to `Finding.other` if that side is the wrong one.

    It is if the rule has evidence for that (`Finding.is_other_wrong`), or if different findings contradict it. The
    places of the findings become related places. A fix, which would adapt them to the wrong side, is left out.
    """
    groups: dict[tuple[Span, str], list[Finding]] = {}
    for finding in findings:
        if finding.other is not None:
            cause = finding.cause if finding.is_other_wrong else ""
            groups.setdefault((finding.other, cause), []).append(finding)
    moved: dict[int, Finding | None] = {}
    for (span, _), group in groups.items():
        is_wrong = any(each.is_other_wrong for each in group)
        if is_wrong or len({(each.code, each.cause or each.message) for each in group}) >= _SMALLEST:
            moved.update((id(each), None) for each in group)
            moved[id(group[0])] = _moved(span, group)
    return [each for finding in findings if (each := moved.get(id(finding), finding)) is not None]


def _moved(span: Span, group: Iterable[Finding]) -> Finding:
    first, *_ = sorted(group, key=lambda one: (SEVERITIES.index(one.severity), one.code, one.span))
    places = {each.span: each for each in group if each.span != span}
    related = tuple(places[each] for each in sorted(places))
    help = (
        first.help
        if first.is_other_wrong
        else "the other places contradict this one; correct this place or all of the others"
    )
    details = {"help": help, "span": span, "fix": None, "chains": (), "cause": "", "other": None, "related": related}
    details["trail"] = ()
    return Finding(**{**first.__dict__, **details})
