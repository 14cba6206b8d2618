"""Consequences: findings that vanish as soon as the cause of another finding is corrected."""

from __future__ import annotations

import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Collection
    from typing import Literal

    from urdfkit.lint.finding import Finding

    Relation = Literal["line", "name", "call", "robot"]
    Pattern = tuple[str, str]
    """Code of a rule, and words of its message."""

_CONSEQUENCES: tuple[tuple[Pattern, Relation, Pattern], ...] = (
    (("E010", ""), "line", ("X124", "")),
    (("E014", "lacks its attribute"), "line", ("E009", "")),
    (("E014", "lacks its attribute"), "line", ("E007", "")),
    (("K956", "unknown package"), "line", ("L104", "unknown name")),
    (("K962", "unknown interface"), "line", ("K965", "")),
    (("K962", "unknown parameter"), "line", ("K971", "")),
    (("K963", ""), "line", ("K956", "which has the controller type")),
    (("K971", ""), "line", ("K974", "")),
    (("C701", ""), "name", ("J418", "")),
    (("C701", ""), "name", ("K963", "")),
    (("I503", ""), "name", ("I507", "")),
    (("J414", ""), "name", ("J413", "")),
    (("J414", ""), "name", ("S904", "")),
    (("J421", ""), "name", ("S909", "")),
    (("K973", "the package is"), "name", ("K956", "")),
    (("L103", ""), "name", ("K968", "unknown option")),
    (("L104", ""), "name", ("L113", "")),
    (("S904", ""), "name", ("J413", "")),
    (("S907", "in the same place"), "name", ("K970", "at the same place")),
    (("S907", ""), "name", ("S909", "")),
    (("T206", ""), "call", ("T207", "")),
    (("C707", "undefined joint"), "robot", ("K965", "lacks joint")),
    (("K972", "the build tool is"), "robot", ("K967", "")),
    (("K973", "needs find_package("), "robot", ("K972", "CMakeLists.txt")),
    (("K973", "the name in setup.py"), "robot", ("K973", "does not exist in this package")),
    (("M102", "<disable_collisions>"), "robot", ("M110", "")),
    (("T204", "loop"), "robot", ("M102", "the reason is")),
    (("T204", "loop"), "robot", ("M105", "")),
    (("T206", ""), "robot", ("Z801", "neither")),
    (("T207", ""), "robot", ("C707", "undefined joint")),
    (("T207", ""), "robot", ("K959", "")),
)
"""Cause, relation and consequence.

The relation is what both have in common: the line, a link, joint or name in the message, the macro call, or only the
robot.
"""

_WITH_FIX = ("E009", "I507")
"""Codes of consequences that are kept if they have a fix, which corrects the cause too."""

_CODES = frozenset(code for _, _, (code, _) in _CONSEQUENCES)


def without_consequences(findings: list[Finding]) -> list[Finding]:
    """Return the findings on one robot without the consequences of another one of them."""
    codes = {finding.code for finding in findings}
    if _CODES.isdisjoint(codes):
        return findings
    dropped: set[int] = set()
    for (code, words), relation, (other, other_words) in _CONSEQUENCES:
        if code not in codes or other not in codes:
            continue
        causes = [finding for finding in findings if finding.code == code and words in finding.message]
        shared = {common for cause in causes for common in _common(cause, relation)}
        for effect in findings:
            if effect.code != other or other_words not in effect.message or id(effect) in dropped:
                continue
            if effect.fix is not None and other in _WITH_FIX:
                continue
            if not shared.isdisjoint(_common(effect, relation)) and not any(effect is cause for cause in causes):
                dropped.add(id(effect))
    return [finding for finding in findings if id(finding) not in dropped]


def _common(finding: Finding, relation: Relation) -> Collection[object]:
    """Return the common part of a cause and its consequence."""
    if relation == "line":
        return ((finding.file, finding.line),)
    if relation == "call":
        return finding.chains
    if relation == "robot":
        return ("robot",)
    return {name for name in (finding.link, finding.joint, *re.findall("`([^`]+)`", finding.message)) if name}
