"""Consequences: findings that vanish as soon as the cause of another finding is corrected."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator
    from typing import Literal

    from urdfkit.lint.finding import Finding

    Relation = Literal["line", "name", "names", "meant", "call", "robot", "unknown"]
    Pattern = tuple[str, str]
    """Code of a rule, and `Finding.kind`; an empty kind matches all findings of the rule."""

_PLACES = (
    *("G619", "J405", "J407", "J411", "J421", "J427", "S908", "S909", "S910", "S917", "S919", "T204"),
    *("T206", "X128"),
)
"""Codes of findings on places, sizes and directions, which explain why links are in each other."""

_ON_PLACES = (
    *("I519", "J421", "J424", "J427", "J428", "J429", "K970", "S901", "S904", "S907", "S908", "S909", "S910"),
    *("S911", "S915", "S918", "S919", "S920", "S921"),
)
"""Codes of findings on places of links, which may be wrong because of a broken tree or unknown values."""

_OF_TREE = ("T201", "T202", "T205", "T206")
"""Codes of findings on links without a place."""

_OF_VALUES = ("X103", "X104", "X124")
"""Codes of findings on values that are unknown."""

_OF_WHOLE_ROBOT = frozenset(("J429", "K970", "S901", "S908", "S911", "S915", "S920", "S921"))
"""Codes of findings that compare a part with all others, so any unknown place may be their cause."""

_OF_INERTIA = ("01", "02", "03", "04", "05", "06", "07", "08", "09", "10", "14", "15", "16", "17", "18", "19")
"""Ends of the codes of findings on a mass or a tensor by itself, which are more precise than comparisons."""

_OF_OTHER_ROS = (("C705", ""), ("K967", ""), ("K972", "dependency"), ("Z807", ""))
"""Findings on a robot whose package.xml names the build system of the other version of ROS."""

_OF_JOINTS = (("C707", "undefined"), ("K959", ""))
"""Findings on undefined joints in ``<ros2_control>`` and in settings of controllers."""

_OF_GROUPS = (("M105", "group"), ("M107", "foreign"), ("M109", "foreign"))
"""Findings on groups of an SRDF that lack joints or links."""

_ON_PARAMETERS = (
    *("K956", "K958", "K959", "K960", "K962", "K967", "K969", "K971", "K974", "K975", "K977", "K979", "K981", "K982"),
    *("K961", "K983", "K984", "K985", "L104", "M108", "M109", "M111", "M112"),
)
"""Codes of findings in YAML with a more precise message than a comparison with the other entries of a file."""

_CONSEQUENCES: tuple[tuple[Pattern, Relation, Pattern], ...] = (
    (("E010", ""), "line", ("X124", "")),
    (("E014", "attribute"), "line", ("E009", "")),
    (("E014", "attribute"), "line", ("E007", "")),
    (("G602", ""), "line", ("K956", "")),
    (("I518", ""), "name", ("I506", "")),
    (("J408", ""), "line", ("S905", "")),
    (("J408", ""), "name", ("I520", "")),
    (("K956", "misspelt"), "line", ("L104", "name")),
    (("K962", ""), "line", ("K965", "")),
    (("K962", ""), "line", ("K971", "")),
    (("K963", ""), "line", ("K956", "controller type")),
    (("K967", ""), "line", ("K956", "controller type")),
    (("K960", ""), "line", ("M112", "unspawned")),
    (("K960", ""), "meant", ("M112", "unspawned")),
    (("K960", "unknown"), "meant", ("K960", "left out")),
    (("K962", ""), "meant", ("K971", "incomplete")),
    (("K980", "remapping"), "meant", ("K980", "unread")),
    (("K967", ""), "line", ("K956", "")),
    (("K968", ""), "line", ("K980", "")),
    (("K958", ""), "names", ("Z828", "argument")),
    (("K969", ""), "line", ("K977", "")),
    *(((code, ""), "line", ("K992", "")) for code in _ON_PARAMETERS),
    *(((code, ""), "line", ("K971", "plugin")) for code in ("K969", "K970", "K975", "K979", "K983", "L104")),
    (("K992", "bounds"), "robot", ("J405", "computed")),
    (("K992", "bounds"), "robot", ("J405", "swapped")),
    (("K992", "numbered"), "meant", ("K962", "")),
    (("K970", ""), "line", ("K974", "")),
    (("K971", ""), "line", ("K956", "")),
    (("K971", ""), "line", ("K974", "")),
    (("K971", ""), "line", ("K977", "")),
    (("K971", ""), "line", ("K981", "")),
    (("K971", ""), "line", ("K982", "")),
    (("K971", ""), "line", ("K985", "")),
    (("K977", ""), "line", ("K980", "")),
    (("K979", ""), "line", ("K974", "")),
    (("K981", ""), "line", ("K974", "")),
    (("K982", ""), "line", ("K981", "")),
    (("K985", ""), "line", ("K977", "")),
    (("T202", ""), "line", ("N304", "")),
    (("T202", ""), "line", ("T205", "")),
    (("X113", ""), "line", ("K956", "")),
    (("X119", ""), "line", ("I506", "")),
    (("Z807", ""), "line", ("K956", "")),
    (("Z807", ""), "line", ("Z802", "")),
    (("C701", ""), "name", ("J418", "")),
    (("C701", ""), "name", ("K963", "")),
    (("K956", "foreign"), "robot", ("C709", "")),
    (("C701", "undefined"), "robot", ("K963", "none")),
    (("C707", "fixed"), "name", ("J418", "")),
    (("C721", ""), "name", ("C719", "")),
    (("C721", ""), "name", ("K963", "")),
    (("C721", ""), "name", ("K965", "")),
    (("C721", ""), "name", ("K978", "")),
    (("E011", ""), "name", ("S908", "")),
    (("G604", ""), "name", ("G620", "")),
    (("G604", ""), "name", ("I513", "")),
    (("G604", ""), "name", ("S909", "")),
    (("G604", ""), "robot", ("K979", "size")),
    (("G615", ""), "name", ("G620", "")),
    (("G617", ""), "name", ("G620", "")),
    (("G619", ""), "name", ("I508", "")),
    (("G619", ""), "name", ("K970", "")),
    (("G620", ""), "name", ("I513", "")),
    (("G620", ""), "name", ("I519", "")),
    (("G620", ""), "name", ("S917", "")),
    (("G620", ""), "robot", ("S921", "")),
    (("G620", ""), "name", ("S908", "")),
    (("G620", ""), "name", ("S911", "")),
    (("I503", ""), "name", ("I507", "")),
    *((("I5" + code, ""), "name", ("I520", "")) for code in _OF_INERTIA),
    *(((code, ""), "name", ("I520", "")) for code in ("G604", "G611", "G615", "G617", "G619", "G620")),
    *(((code, ""), "robot", ("I520", "")) for code in ("X119", "X103", "X104")),
    (("I519", "swapped"), "line", ("I507", "")),
    (("I519", "swapped"), "name", ("I507", "")),
    (("I506", ""), "name", ("I503", "")),
    (("I506", ""), "name", ("I507", "")),
    (("I506", ""), "name", ("I508", "")),
    (("I514", ""), "name", ("I507", "")),
    (("I514", ""), "name", ("I508", "")),
    (("J405", ""), "name", ("S910", "")),
    (("J414", ""), "name", ("J413", "")),
    (("Z802", "fixed"), "name", ("J418", "")),
    (("J414", ""), "name", ("S904", "")),
    (("J421", ""), "name", ("K970", "")),
    (("J421", ""), "name", ("S909", "")),
    (("J421", ""), "robot", ("S918", "")),
    (("S909", ""), "name", ("S917", "")),
    (("J422", ""), "name", ("J423", "")),
    (("J422", ""), "name", ("J424", "")),
    (("J423", ""), "name", ("S910", "")),
    (("J427", ""), "name", ("J421", "")),
    (("J427", ""), "name", ("S915", "")),
    (("J416", ""), "line", ("N304", "")),
    (("K963", ""), "name", ("K971", "incomplete")),
    (("K970", ""), "robot", ("K979", "size")),
    (("G620", ""), "robot", ("K979", "size")),
    (("K973", "missing"), "line", ("K973", "folder")),
    (("K973", "name"), "name", ("K956", "")),
    (("K973", "name"), "names", ("M111", "")),
    (("K971", "twice"), "name", ("K962", "")),
    (("K971", "twice"), "name", ("M112", "")),
    (("K975", ""), "name", ("K962", "")),
    (("K975", ""), "name", ("M112", "")),
    (("K975", ""), "name", ("K976", "foreign")),
    *((("K976", "side"), "name", each) for each in (("K971", ""), ("K975", ""), ("K976", "foreign"), ("M112", ""))),
    (("K976", "left out"), "name", ("M112", "")),
    (("K965", ""), "name", ("M112", "")),
    (("K968", ""), "name", ("K980", "")),
    (("Z826", ""), "name", ("K977", "")),
    (("Z826", ""), "names", ("K969", "topic")),
    (("Z832", "remapping"), "names", ("K977", "")),
    (("K977", ""), "name", ("K980", "")),
    (("K983", "transform"), "name", ("L124", "")),
    (("L103", ""), "name", ("K968", "option")),
    (("L104", ""), "name", ("L113", "")),
    (("L104", ""), "meant", ("L126", "")),
    (("L104", "name"), "line", ("K980", "")),
    (("L107", "replaced"), "line", ("L106", "")),
    (("L108", ""), "line", ("K960", "")),
    (("L110", ""), "line", ("L104", "name")),
    (("L108", ""), "line", ("K968", "")),
    (("S904", ""), "name", ("J413", "")),
    (("S917", ""), "name", ("G619", "")),
    (("S917", ""), "name", ("J413", "")),
    (("S917", ""), "name", ("S919", "")),
    (("S907", ""), "name", ("K970", "place")),
    (("S905", ""), "name", ("S918", "")),
    (("S907", ""), "name", ("S909", "")),
    (("K959", ""), "meant", ("K962", "")),
    (("M104", ""), "meant", ("M105", "")),
    (("M104", ""), "name", ("M105", "")),
    (("M104", ""), "name", ("M107", "")),
    (("M104", ""), "names", ("M108", "")),
    (("M104", ""), "names", ("M109", "")),
    *((("M105", "side"), "name", each) for each in _OF_GROUPS),
    *((("M105", "repeated"), "name", each) for each in _OF_GROUPS[1:]),
    (("M106", ""), "name", ("M107", "")),
    (("M106", "passive"), "robot", ("M105", "passive")),
    (("M106", "pair"), "name", ("M110", "")),
    (("M107", "foreign"), "line", ("M106", "")),
    (("M107", "foreign"), "name", ("M109", "foreign")),
    (("M110", "parent"), "name", ("M107", "foreign")),
    (("M107", "foreign"), "name", ("M110", "pair")),
    (("M109", ""), "line", ("M112", "partial")),
    (("M110", ""), "name", ("M102", "reason")),
    (("S909", ""), "name", ("J427", "")),
    (("S909", ""), "name", ("M102", "reason")),
    (("S909", ""), "name", ("M105", "")),
    (("S909", ""), "name", ("M110", "")),
    (("S909", ""), "name", ("S910", "")),
    (("S910", ""), "name", ("J424", "")),
    (("S908", ""), "name", ("S911", "")),
    (("T207", ""), "name", ("C701", "")),
    (("T207", ""), "name", ("C707", "fixed")),
    (("T207", ""), "name", ("M107", "")),
    (("T204", ""), "name", ("T203", "")),
    (("T205", ""), "name", ("T203", "")),
    (("T206", ""), "name", ("C701", "")),
    (("T206", ""), "name", ("T201", "")),
    (("X104", ""), "name", ("X107", "")),
    (("T206", ""), "call", ("T207", "")),
    (("C707", "undefined"), "robot", ("K965", "joint")),
    (("K965", ""), "robot", ("K978", "")),
    (("K968", "manager"), "robot", ("K980", "namespace")),
    (("L127", ""), "robot", ("K980", "namespace")),
    (("K968", "manager"), "robot", ("L117", "namespace")),
    *((("K972", "build tool"), "robot", (code, kind)) for code, kind in _OF_OTHER_ROS),
    *((("K972", "build type"), "robot", (code, kind)) for code, kind in _OF_OTHER_ROS),
    (("K973", "find_package"), "robot", ("K972", "build tool")),
    (("K973", "find_package"), "robot", ("K972", "build type")),
    (("K973", "setup.py"), "robot", ("K973", "missing")),
    (("M102", "disable_collisions"), "robot", ("M110", "")),
    *((("S909", ""), "robot", each) for each in _OF_GROUPS),
    (("T201", ""), "robot", ("M102", "reason")),
    (("T201", ""), "robot", ("M105", "")),
    (("T202", ""), "robot", ("M102", "reason")),
    (("T202", ""), "robot", ("M105", "")),
    (("T204", ""), "robot", ("M102", "reason")),
    (("T204", ""), "robot", ("M105", "")),
    (("T204", ""), "robot", ("M110", "")),
    (("G604", ""), "robot", ("K968", "height")),
    (("G619", ""), "robot", ("K968", "height")),
    (("S908", ""), "robot", ("K968", "height")),
    (("S911", ""), "robot", ("K968", "height")),
    (("T206", ""), "robot", ("C721", "")),
    (("T206", ""), "robot", ("M104", "link")),
    (("T206", ""), "robot", ("M105", "")),
    (("T206", ""), "robot", ("S910", "")),
    (("T206", ""), "robot", ("Z801", "reference")),
    (("T206", ""), "robot", ("Z802", "undefined")),
    (("T207", ""), "robot", ("C701", "undefined")),
    (("T207", ""), "robot", ("C707", "undefined")),
    (("T207", ""), "robot", ("J416", "undefined")),
    (("T207", ""), "robot", ("K959", "")),
    (("T207", ""), "robot", ("K968", "joint")),
    (("T207", ""), "robot", ("M104", "joint")),
    (("T207", ""), "robot", ("M105", "")),
    (("T207", ""), "robot", ("M108", "joint")),
    (("T207", ""), "robot", ("M109", "")),
    (("T207", ""), "robot", ("Z802", "undefined")),
    (("Z817", ""), "robot", ("K969", "topic")),
    (("J405", ""), "name", ("J420", "")),
    *((("J407", ""), "name", (code, "")) for code in ("C719", "J420", "M107", "S919")),
    (("J408", ""), "line", ("S915", "")),
    (("S907", ""), "line", ("S909", "")),
    (("S909", ""), "name", ("K970", "")),
    (("G619", ""), "name", ("S910", "")),
    (("I514", ""), "name", ("J429", "")),
    (("T206", "call"), "robot", ("T207", "")),
    (("T206", ""), "robot", ("J416", "")),
    (("T201", ""), "name", ("I511", "")),
    (("T202", ""), "names", ("T201", "")),
    (("T204", ""), "robot", ("T203", "")),
    (("S917", ""), "name", ("J424", "")),
    (("J421", ""), "robot", ("K979", "size")),
    (("K966", ""), "robot", ("X124", "load_yaml")),
    (("K972", ""), "meant", ("K956", "")),
    (("L101", ""), "meant", ("L102", "")),
    *(((code, ""), "robot", ("K968", "height")) for code in _OF_VALUES),
    (("X104", ""), "line", ("X119", "")),
    (("C721", ""), "name", ("C720", "")),
    (("X103", ""), "line", ("X104", "")),
    *((("X128", "calls"), "robot", each) for each in _OF_JOINTS),
    *((("X128", ""), "name", each) for each in _OF_JOINTS),
    *(((code, ""), "robot", (other, "")) for code in _OF_TREE for other in _ON_PLACES),
    *(((code, ""), "unknown", (other, "")) for code in _OF_VALUES for other in (*_ON_PLACES, "I513")),
    *(((code, ""), "robot", ("S920", "")) for code in _PLACES),
    *(((code, ""), "robot", ("S921", "")) for code in (*_PLACES, "S920")),
)
"""Cause, relation and consequence.

The relation is what both have in common: the line, the link, the joint or one of `Finding.names`, one of these names
alone (``names``), the macro call or a call inside of it, or only the robot; ``meant`` is the name that the cause
suggests and that the consequence misses, or that the cause has and the consequence suggests. The consequences of an
``unknown`` value concern parts that depend on it.
"""

_WITH_FIX = (("E014", "E009"), ("I503", "I507"))
"""Codes of causes and of consequences that are kept if they have a fix, which corrects the cause too."""

_CODES = frozenset(code for _, _, (code, _) in _CONSEQUENCES)


def without_consequences(findings: list[Finding], unknown: Callable[[], Collection[str]] = tuple) -> list[Finding]:
    """Return the findings on one robot without the consequences of another one of them.

    Args:
        findings: the findings.
        unknown: returns the names of the parts that depend on unknown values.
    """
    codes = {finding.code for finding in findings}
    if _CODES.isdisjoint(codes):
        return findings
    dropped: set[int] = set()
    for (code, kind), relation, (other, other_kind) in _CONSEQUENCES:
        if code not in codes or other not in codes:
            continue
        causes = list(_matching(findings, code, kind))
        if relation == "unknown":
            parts = set(unknown())
            dropped.update(id(each) for each in _matching(findings, other, other_kind) if _is_unknown(each, parts))
            continue
        shared = {common for cause in causes for common in _common(cause, relation)}
        for effect in _matching(findings, other, other_kind):
            if id(effect) in dropped or (effect.fix is not None and (code, other) in _WITH_FIX):
                continue
            common = _common(effect, relation, is_effect=True)
            if not shared.isdisjoint(common) and not any(effect is cause for cause in causes):
                dropped.add(id(effect))
    return [finding for finding in findings if id(finding) not in dropped]


def _is_unknown(finding: Finding, parts: Collection[str]) -> bool:
    """Return whether a finding on a place may vanish when the values of some parts become known."""
    names = (finding.link, finding.joint, *finding.names)
    return bool(parts) if finding.code in _OF_WHOLE_ROBOT else any(name in parts for name in names)


def _matching(findings: list[Finding], code: str, kind: str) -> Iterator[Finding]:
    return (finding for finding in findings if finding.code == code and kind in ("", finding.kind))


def _common(finding: Finding, relation: Relation, *, is_effect: bool = False) -> Collection[object]:
    """Return the common part of a cause and its consequence."""
    if relation == "line":
        return ((finding.file, finding.line),)
    if relation == "call":
        chains = finding.chains
        return [chain[first:] for chain in chains for first in range(len(chain))] if is_effect else chains
    if relation == "meant":
        written = finding.suggestion.written if finding.suggestion is not None else ""
        names = (finding.joint, *finding.names) if is_effect else (written,)
        return {name for name in (*names, finding.meant) if name}
    if relation == "robot":
        return ("robot",)
    if relation == "names":
        return finding.names
    return {name for name in (finding.link, finding.joint, *finding.names) if name}
