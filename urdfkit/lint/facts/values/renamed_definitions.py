"""Links, joints, macros, properties and parameters whose definition has another name than their uses."""

from __future__ import annotations

import re
from collections import Counter
from functools import cached_property

from urdfkit.description.urdf.robot import Link
from urdfkit.lint.finding import Finding

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.urdf.robot import Joint
    from urdfkit.description.xml.source import Position, Span
    from urdfkit.lint.model.model import Model

    Place = tuple[str, int]

_OF_NAMES = re.compile("C70[17]|J416|K959|M104|T20[12]|Z80[1-4]")
"""Matches codes of findings on names of links and joints that do not exist."""

_OF_MOVING = re.compile("C70[17]|J416|K959")
"""Matches codes of findings on names that only joints which move have."""

_COMMENT = re.compile(r"<!--.*?-->|(?<![\w\"'&/])#[^\n]*", re.DOTALL)
_STANDARD = ("base_link", "base_footprint")
"""Names of links in REP 105 and REP 120, which are right."""

_SMALLEST = 2
"""Number of places that use one name from which on that name is right, if no place uses the defined one."""


class RenamedDefinitions:
    """Decides whether an undefined name is right, and the definition of the suggested name is wrong.

    Args:
        model: the linted model.
    """

    def __init__(self, model: Model) -> None:
        self._model = model

    def is_wrong(self, meant: str, name: str, definition: Place, uses: int = 0) -> bool:
        """Return whether the definition has the wrong name.

        That is so if no other place uses the defined name, and if several places have the undefined name, or if only
        the undefined name consists of words that other names have too. It is not if only the defined name does, and if
        one file has all places.

        Args:
            meant: the defined name that a finding suggests.
            name: the undefined name.
            definition: file and line of the definition.
            uses: number of places with a finding on the undefined name.
        """
        if meant in _STANDARD or self.places(meant) - {definition}:
            return False
        places = self.places(name) - {definition}
        words, others = (set(re.findall(r"[^\W\d_]+", each)) for each in (meant, name))
        own, strange = words - others, others - words
        is_shared = all(self._has_word(word, places) for word in strange)
        is_own_shared = any(self._has_word(word, {definition}) for word in own)
        is_in_files = len({file for file, _ in places}) > 1
        if is_own_shared and not is_shared and not is_in_files:  # The same slip in several places.
            return False
        return max(uses, len(places)) >= _SMALLEST or (bool(own) and is_shared and not is_own_shared)

    def places(self, name: str) -> set[Place]:
        """Return file and line of each place that has a name, as written or with the values of expressions."""
        found = {(file, text.count("\n", 0, at) + 1) for file, text in self._texts.items() for at in _at(name, text)}
        return found | self._computed.get(name, set())

    def _has_word(self, word: str, excluded: set[Place]) -> bool:
        """Return whether another line has a word as a part of a name."""
        pattern = re.compile(rf"(?<![^\W_]){re.escape(word)}(?![^\W_])")
        return any(
            (file, text.count("\n", 0, match.start()) + 1) not in excluded
            for file, text in self._texts.items()
            for match in pattern.finditer(text)
        )

    @cached_property
    def _texts(self) -> dict[str, str]:
        """File → its text without comments, in which each line stays in its place."""
        model = self._model
        files = {**model.related_files, **model.expanded.sources} if model.robot.links else model.expanded.sources
        return {
            file: _COMMENT.sub(lambda comment: re.sub(r"[^\n]", " ", comment[0]), source.text)
            for file, source in files.items()
        }

    @cached_property
    def _computed(self) -> dict[str, set[Place]]:
        """Name → the places that compute it."""
        found: dict[str, set[Place]] = {}
        for element in self._model.robot.element.walk():
            if element.origin.expansions:
                at = element.origin.position
                for value in (*element.attributes.values(), (element.text or "").strip()):
                    if value and len(value) < _LONGEST:
                        found.setdefault(value, set()).add((at.file, at.line))
        return found


_LONGEST = 100
"""Longer attributes are no names [characters]."""


def _at(name: str, text: str) -> Iterator[int]:
    return (match.start() for match in re.finditer(rf"(?<![\w$]){re.escape(name)}(?!\w)", text))


def with_renamed_definitions(findings: list[Finding], model: Model) -> list[Finding]:
    """Return the findings; those on uses of a link or joint that has another name have its definition as other side."""
    lacking = [
        each for each in findings if _OF_NAMES.match(each.code) and each.other is None and each.severity != "note"
    ]
    if not any(each.meant for each in lacking):
        return findings
    parts: dict[str, Link | Joint] = {**model.robot.joint_by_name, **model.robot.link_by_name}
    uses: dict[Position, dict[Span, str]] = {}
    meant: dict[Position, str] = {}
    renamed: dict[str, str] = {}
    for finding in lacking:
        part = parts.get(finding.meant)
        is_fixed = part is not None and not isinstance(part, Link) and part.type == "fixed"
        if is_fixed and _OF_MOVING.match(
            finding.code
        ):  # Few files name fixed joints, so one without uses may be right.
            continue
        if finding.meant in parts and finding.suggestion is not None and finding.suggestion.written:
            at = parts[finding.meant].element.origin.position
            uses.setdefault(at, {})[finding.span] = finding.suggestion.written
            renamed.setdefault(finding.suggestion.written, finding.meant)
            meant.setdefault(at, finding.meant)
    definitions = RenamedDefinitions(model)
    parts_at = Counter(part.element.origin.position for part in parts.values())
    places: dict[str, tuple[Span, str]] = {}
    for at, names in uses.items():
        if parts_at[at] > len(set(names.values())):  # Other calls of the macro define names that are used.
            continue
        pairs = {name: renamed[name] for name in names.values()}
        if all(definitions.is_wrong(other, name, (at.file, at.line), len(names)) for name, other in pairs.items()):
            kind = parts[meant[at]].element.tag
            for name, other in pairs.items():
                message = f"{kind} `{other}` is not used; did you mean `{name}`, which is used but undefined?"
                places[name] = model.span(at, "name"), message
    moved = {id(finding): _moved(finding, places) for finding in lacking} if places else {}
    return [moved.get(id(finding), finding) for finding in findings]


def _moved(finding: Finding, places: dict[str, tuple[Span, str]]) -> Finding:
    written = finding.suggestion.written if finding.suggestion is not None else ""
    names = (written, finding.link, finding.joint, *finding.names)
    place = next((places[name] for name in names if name in places), None)
    if place is None:
        return finding
    details = {"other": place[0], "is_other_wrong": True, "cause": "renamed", "message": place[1], "help": None}
    return Finding(**{**finding.__dict__, **details})
