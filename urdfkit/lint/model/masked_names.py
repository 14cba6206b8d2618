"""Masked names: names that do not exist in the expanded robot, but may be defined in a part that a fault dropped.

The linter continues after an error. The source of the dropped part is often available, for example in a condition that
cannot be evaluated or in a recursive macro; a name is then masked only if that source can define it. An unreadable part
(a missing or malformed file, an undefined macro) may define any name; a name that is a typo of an existing name is then
reported as a note.
"""

from __future__ import annotations

import re

from urdfkit.lint.finding import Finding
from urdfkit.lint.model.xacro_prefix import misspelt_in_robot

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from typing import Protocol

    from urdfkit.description.urdf.robot import Robot
    from urdfkit.description.xacro.expanded import Expanded
    from urdfkit.description.xacro.faults import Fault
    from urdfkit.description.xml.source import Position
    from urdfkit.lint.model.tags import Document, Tag

    class ExpandedModel(Protocol):
        """The members of `urdfkit.lint.model.model.Model` that this module uses."""

        @property
        def robot(self) -> Robot:
            """The parsed robot."""

        @property
        def expanded(self) -> Expanded:
            """The result of the expansion."""

        @property
        def masked_names(self) -> MaskedNames:
            """Names that missing parts of the robot may define."""

        def document(self, file: str) -> Document:
            """Return the tags of a file."""

        def tag(self, position: Position) -> Tag | None:
            """Return the tag at a position."""


_NAMED = ("link", "joint")
_EXPRESSION = r"(\$\([^()]*\)|\$\{[^{}]*\})"
_UNQUOTED_NAME = r"\b(?:name|link)\s*=\s*[\"']?([^\"'<>]*)"
"""Names in a file that is not well-formed; quotes may be missing."""

_ANY = ".*"
_DIRECTIVES = frozenset(("arg", "property", "if", "unless", "element", "attribute", "macro"))
_CONDITIONS = ("xacro:if", "xacro:unless")
_BLOCK_PARENTS = frozenset(("robot", "xacro:macro", *_CONDITIONS))
"""Parents in which a block may contain links and joints; elsewhere blocks contain origins and shapes."""

_CUTOFF = 0.8
"""Minimum similarity of the one word that differs in a typo (`difflib.SequenceMatcher.ratio`): `bse`, `lnk`, `weel`."""


_MAX_PATTERN = 2_000
"""Longest pattern of a name; a macro that passes ``${x}${x}`` to itself doubles it with each call."""


class MaskedNames:
    """Names that the parts of a robot dropped by faults may define.

    Args:
        model: the linted model.

    Attributes:
        unreadable: a part that may define any name, with the reason; empty if all dropped parts have source.
        patterns: patterns of link and joint names in the dropped parts.
        children: patterns of the child links of joints in the dropped parts.
    """

    def __init__(self, model: ExpandedModel) -> None:
        self._model = model
        self.unreadable = ""
        self.patterns: set[str] = set()
        self.children: set[str] = set()
        self._seen: set[tuple[str, tuple[tuple[str, str], ...]]] = set()
        for child in model.robot.element.children:
            if child.tag in _NAMED or misspelt_in_robot(child) is not None:
                name = child.get("name") or ""
                if child.tag not in _NAMED or "$" in name:
                    self.patterns.add(_pattern(name, {}))
        for joint in model.robot.joints:
            if joint.child is None or "$" in joint.child:
                self.children.add(_pattern(joint.child or "${}", {}))
        for position, attribute in model.expanded.unresolved:
            tag = model.tag(position) if attribute == "value" else None
            if tag is not None and tag.name in _CONDITIONS:
                self._read(tag.children, {})
        for fault in model.expanded.faults:
            if "meant" not in fault.details and fault.details.get("cause") != "unbound prefix":
                self._take(fault)

    def has(self, name: str) -> bool:
        """Return whether a dropped part with available source may define a link or joint of that name."""
        return any(re.fullmatch(pattern, name) for pattern in self.patterns)

    def has_child(self, name: str) -> bool:
        """Return whether a dropped joint may have that link as its child, or the link's name is unknown."""
        return bool(self.unreadable) or "$" in name or any(re.fullmatch(pattern, name) for pattern in self.children)

    def _take(self, fault: Fault) -> None:
        kind, tag = fault.kind, self._model.tag(fault.position)
        if kind == "include-not-found":
            self.unreadable = f"{fault.name}, which was not found"
        elif kind == "package-not-found":
            self.unreadable = f"package `{fault.name}`, which was not found"
        elif kind == "too-many":
            self.unreadable = "the part that was not expanded"
        elif kind == "macro-arguments" and tag is not None and not fault.details:  # of its blocks
            for called, values in self._called(tag, fault.name or "", {}):
                self._read([called], values)
        elif kind == "undefined-macro" and fault.defined_at is None:
            if tag is not None:
                for called, values in self._called(tag, fault.name or "", {}):
                    self._read([called], values)
        elif kind == "xml":
            names = re.findall(_UNQUOTED_NAME, self._model.document(fault.position.file).source.text)
            self.unreadable = f"{fault.position.file}, which is not well-formed"
            self.patterns |= {_pattern(name, {}) for name in names}
            self.children |= self.patterns
        elif kind in ("conditional", "other") and tag is not None:
            self._read([tag], {})
        elif kind == "recursion":
            for name in fault.details.get("cycle", ()):
                self._read(self._definitions.get(name, ()), {})
        elif kind == "undefined-block" and fault.expansions:
            call = self._model.tag(fault.expansions[0].position)
            self._read(call.children if call is not None else (), {})

    def _read(self, tags: Iterable[Tag], values: Mapping[str, str]) -> None:
        """Collect the names in source tags; macro parameters become patterns."""
        pending = [(tag, values) for tag in tags][::-1]
        while pending:
            tag, values = pending.pop()
            pending += [(child, values) for child in reversed(tag.children)]
            if tag.name in _NAMED and (name := tag.attributes.get("name")) is not None:
                self.patterns.add(_pattern(name.value, values))
            elif tag.name == "child" and (name := tag.attributes.get("link")) is not None:
                self.children.add(_pattern(name.value, values))
            prefix, _, local = tag.name.rpartition(":")
            if prefix == "xacro" and local == "include":
                self.unreadable = "a file that was not included"
            elif prefix == "xacro" and local == "insert_block":
                if tag.parent is None or tag.parent.name in _BLOCK_PARENTS:
                    self.unreadable = "a block that was not inserted"
            elif (prefix == "xacro" and local not in _DIRECTIVES) or local in self._definitions:
                pending += self._called(tag, local, values)[::-1]

    def _called(self, tag: Tag, name: str, values: Mapping[str, str]) -> list[tuple[Tag, Mapping[str, str]]]:
        """Return the source tags of a called macro that were not read with these arguments yet, and the arguments."""
        bodies = self._definitions.get(name.rpartition(".")[2], ())
        if not bodies:
            self.unreadable = f"macro `{name}`, which is not defined"
        arguments = {key: _pattern(one.value, values) for key, one in tag.attributes.items()}
        key = name, tuple(sorted(arguments.items()))
        if key not in self._seen and len(self._seen) < 1_000:
            self._seen.add(key)
            return [(child, arguments) for body in bodies for child in body.children]
        return []

    @property
    def _definitions(self) -> dict[str, list[Tag]]:
        """Macro name → its definitions in all files."""
        if "_defined" not in self.__dict__:
            self._defined: dict[str, list[Tag]] = {}
            for file in self._model.expanded.sources:
                document = self._model.document(file)
                if "macro" in document.source.text:
                    for tag in (tag for root in document.roots for tag in root.walk() if tag.name == "xacro:macro"):
                        if (name := tag.attributes.get("name")) is not None:
                            self._defined.setdefault(name.value.removeprefix("xacro:"), []).append(tag)
        return self._defined


def unless_masked(
    model: ExpandedModel, name: str, near: str | None, finding: Finding, *, is_repaired: bool = False
) -> Iterator[Finding]:
    """Yield a finding about an undefined name, unless a dropped part may define the name.

    Args:
        model: the linted model.
        name: the undefined name of a link or joint.
        near: the most similar existing name; None if none is similar.
        finding: the finding that reports the name as undefined.
        is_repaired: whether viewer and simulator repair the defect, which they report at the same place.

    Yields:
        The finding; as a note without fix if an unreadable part may define the name but the name is a typo of another,
        or viewer and simulator repair the defect; nothing if a dropped part may define the name, or if the name itself
        was not evaluated.
    """
    if not model.robot.links or "$" in name:
        return
    masked = model.masked_names
    if masked.has(name):
        return
    if not masked.unreadable:
        yield finding
    elif is_repaired or (near is not None and is_typo(name, near)):
        help, cause = f"it may be in {masked.unreadable}", masked.unreadable if is_repaired else ""
        yield Finding(**{**finding.__dict__, "severity": "note", "help": help, "fix": None, "cause": cause})


def is_typo(name: str, near: str) -> bool:
    """Return whether a name is a typo of another (`bse_link`), not a sibling (`left_link` or `link_2`)."""
    words, others = (re.findall(r"\d+|[^\W\d_]+", text.lower()) for text in (name, near))
    if len(words) != len(others):
        return "".join(words) == "".join(others)
    from difflib import SequenceMatcher

    pairs = [(a, b) for a, b in zip(words, others, strict=True) if a != b]
    return len(pairs) < 2 and all(
        (len(a) > 2 and a.isalpha() and sorted(a) == sorted(b)) or SequenceMatcher(None, a, b).ratio() >= _CUTOFF
        for a, b in pairs
    )


def _pattern(name: str, values: Mapping[str, str]) -> str:
    """Return the pattern of a source name; `values` are the patterns of its parameters."""
    parts = []
    for part in re.split(_EXPRESSION, name):
        if part.startswith(("${", "$(")):
            parts.append(values.get(part[2:-1].strip(), _ANY))
        else:
            parts.append(re.escape(part))
    return "".join(parts) if sum(map(len, parts)) <= _MAX_PATTERN else _ANY
