"""What a fault may have hidden: names that nothing has here, and that could be in what is missing.

After an error the linter goes on. What the error has dropped is mostly written somewhere all the same: in a condition
that nobody can decide, in a macro that calls itself. A name is then in doubt only where it could be written there. What
nobody can read, a file that is not there or breaks off, a macro that is defined nowhere, may hold any name; a name that
is a slip of one that is there is spoken of nevertheless, as a note.
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

    class Model(Protocol):
        """What is asked here of `urdfkit.lint.model.model.Model`."""

        @property
        def robot(self) -> Robot:
            """The robot."""

        @property
        def expanded(self) -> Expanded:
            """The outcome of the expansion."""

        @property
        def hidden(self) -> Hidden:
            """What may be in what is missing."""

        def document(self, file: str) -> Document:
            """Return the tags of a file."""

        def tag(self, position: Position) -> Tag | None:
            """Return the tag at a position."""


_NAMED = ("link", "joint")
_EXPRESSION = r"(\$\([^()]*\)|\$\{[^{}]*\})"
_LOOSE = r"\b(?:name|link)\s*=\s*[\"']?([^\"'<>]*)"
"""Names in a file that breaks off, wherever a quote may lack."""

_ANY = ".*"
_DIRECTIVES = frozenset(("arg", "property", "if", "unless", "element", "attribute", "macro"))
_CONDITIONS = ("xacro:if", "xacro:unless")
_PLACES = frozenset(("robot", "xacro:macro", *_CONDITIONS))
"""Where blocks may bring links and joints; elsewhere they bring origins and shapes."""

_LIKENESS = 0.8
"""How near the one word that differs has to be for a slip (`difflib.SequenceMatcher.ratio`): `bse`, `lnk`, `weel`."""


class Hidden:
    """What is missing from a robot, as far as faults tell.

    Args:
        model: what is being linted.

    Attributes:
        anything: what may hold any name, and why it is not known; empty where all that is missing can be read.
        patterns: of the names that links and joints could have in what is missing.
        children: of the links that joints in there could have as children.
    """

    def __init__(self, model: Model) -> None:
        self._model = model
        self.anything = ""
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
            tag = model.tag(position) if attribute is None else None
            if tag is not None and tag.name in _CONDITIONS:
                self._read(tag.children, {})
        for fault in model.expanded.faults:
            if "meant" not in fault.details and not fault.message.startswith("unbound prefix"):
                self._take(fault)

    def has(self, name: str) -> bool:
        """Return whether a link or joint of that name could be in what is missing and can be read."""
        return any(re.fullmatch(pattern, name) for pattern in self.patterns)

    def has_child(self, name: str) -> bool:
        """Return whether a joint in what is missing could have that link as its child, or nobody knows its name."""
        return bool(self.anything) or "$" in name or any(re.fullmatch(pattern, name) for pattern in self.children)

    def _take(self, fault: Fault) -> None:
        kind, tag = fault.kind, self._model.tag(fault.position)
        if kind == "include-not-found":
            self.anything = f"{fault.name}, which is not there"
        elif kind == "package-not-found":
            self.anything = f"package `{fault.name}`, which is not there"
        elif kind == "too-many":
            self.anything = "what was not expanded any more"
        elif kind == "undefined-macro" and fault.defined_at is None:
            if tag is not None:
                self._call(tag, fault.name or "", {})
        elif kind == "xml":
            loose = re.findall(_LOOSE, self._model.document(fault.position.file).source.text)
            self.anything = f"{fault.position.file}, which breaks off"
            self.patterns |= {_pattern(name, {}) for name in loose}
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
        """Note the names in what is written, parameters being patterns."""
        for tag in tags:
            if tag.name in _NAMED and (name := tag.attributes.get("name")) is not None:
                self.patterns.add(_pattern(name.value, values))
            elif tag.name == "child" and (name := tag.attributes.get("link")) is not None:
                self.children.add(_pattern(name.value, values))
            prefix, _, local = tag.name.rpartition(":")
            if prefix == "xacro" and local == "include":
                self.anything = "a file that was not included"
            elif prefix == "xacro" and local == "insert_block":
                if tag.parent is None or tag.parent.name in _PLACES:
                    self.anything = "a block that was not inserted"
            elif (prefix == "xacro" and local not in _DIRECTIVES) or local in self._definitions:
                self._call(tag, local, values)
            self._read(tag.children, values)

    def _call(self, tag: Tag, name: str, values: Mapping[str, str]) -> None:
        bodies = self._definitions.get(name.rpartition(".")[2], ())
        if not bodies:
            self.anything = f"macro `{name}`, which is defined nowhere"
        given = {key: _pattern(one.value, values) for key, one in tag.attributes.items()}
        key = name, tuple(sorted(given.items()))
        if key not in self._seen and len(self._seen) < 1_000:
            self._seen.add(key)
            for body in bodies:
                self._read(body.children, given)

    @property
    def _definitions(self) -> dict[str, list[Tag]]:
        """The macros that any of the files defines, by name."""
        if "_defined" not in self.__dict__:
            self._defined: dict[str, list[Tag]] = {}
            for file in self._model.expanded.sources:
                document = self._model.document(file)
                if "macro" in document.source.text:
                    for tag in (tag for root in document.roots for tag in root.walk() if tag.name == "xacro:macro"):
                        if (name := tag.attributes.get("name")) is not None:
                            self._defined.setdefault(name.value.removeprefix("xacro:"), []).append(tag)
        return self._defined


def doubted(model: Model, name: str, near: str | None, finding: Finding) -> Iterator[Finding]:
    """Yield a finding on a name that nothing has, as far as that is certain.

    Args:
        model: what is being linted.
        name: of a link or joint.
        near: the nearest name that there is; None where none is near.
        finding: says that there is none of that name.

    Yields:
        The finding; without its fix, as a note, where the name may be in what nobody can read but is a slip of another;
        nothing where it may be in what is missing, or could not be evaluated itself.
    """
    if not model.robot.links or "$" in name:
        return
    hidden = model.hidden
    if hidden.has(name):
        return
    if not hidden.anything:
        yield finding
    elif near is not None and is_slip(name, near):
        help = f"it may be in {hidden.anything}"
        yield Finding(**{**finding.__dict__, "severity": "note", "help": help, "fix": None})


def is_slip(name: str, near: str) -> bool:
    """Return whether a name is another one misspelt, not a sister of it: `bse_link`, not `left_link` or `link_2`."""
    words, others = (re.findall(r"\d+|[^\W\d_]+", text.lower()) for text in (name, near))
    if len(words) != len(others):
        return "".join(words) == "".join(others)
    from difflib import SequenceMatcher

    pairs = [(a, b) for a, b in zip(words, others, strict=True) if a != b]
    return len(pairs) < 2 and all(SequenceMatcher(None, a, b).ratio() >= _LIKENESS for a, b in pairs)


def _pattern(name: str, values: Mapping[str, str]) -> str:
    """Return the pattern of a name as written, given those of the parameters in it."""
    parts = []
    for part in re.split(_EXPRESSION, name):
        if part.startswith(("${", "$(")):
            parts.append(values.get(part[2:-1].strip(), _ANY))
        else:
            parts.append(re.escape(part))
    return "".join(parts)
