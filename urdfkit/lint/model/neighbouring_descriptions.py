"""NeighbouringDescriptions: the descriptions in neighbouring packages, which may define a name."""

from __future__ import annotations

import re
from bisect import bisect_right
from functools import cached_property
from pathlib import Path

from urdfkit.errors import ResourceError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable

    from urdfkit.description.xacro.expanded import Expanded


class NeighbouringDescriptions:
    """The descriptions in the packages of related files and in their dependencies, read once.

    Args:
        expanded: the expanded robot.
        package: its package folder, or None.
        related_files: files of other kinds that belong to the robot.
    """

    def __init__(self, expanded: Expanded, package: Path | None, related_files: Iterable[str]) -> None:
        self._expanded, self._package, self._related_files = expanded, package, related_files
        self._names_of: dict[str, tuple[frozenset[str], re.Pattern[str]]] = {}

    def define(self, tag: str, name: str) -> bool:
        """Return whether they may define a link or joint, for any values of the arguments.

        Args:
            tag: ``link`` or ``joint``.
            name: name of the link or joint.
        """
        if tag not in self._names_of:
            literal, computed = self._names(tag)
            self._names_of[tag] = literal, re.compile("|".join(computed) or r"(?!)")
        literal, pattern = self._names_of[tag]
        return name in literal or pattern.fullmatch(name) is not None

    def mention(self, text: str) -> bool:
        """Return whether one of them that the robot does not include contains a text."""
        return any(text in each for path, each in self._texts.items() if path not in self._own)

    @cached_property
    def unresolved_package(self) -> str:
        """A package that they include files from and that is not found here; empty if all are found."""
        texts = "\n".join(self._texts.values())
        for name in dict.fromkeys(re.findall(r"<xacro:include\b[^<>]*\$\(find\s+([\w-]+)\)", texts)):
            try:
                self._expanded.packages.find(str(name))
            except ResourceError:
                return str(name)
        return ""

    def _names(self, tag: str) -> tuple[frozenset[str], list[str]]:
        """Return the names of links or joints, and patterns of those with expressions."""
        texts, own = self._texts, self._own
        is_fixed = not any(re.search(r"<(?:xacro:)?(?:if|unless|arg)\b", text) for text in own.values())
        texts = {path: text for path, text in texts.items() if path not in own} if is_fixed else {**own, **texts}
        every = "\n".join(texts.values())
        # An element whose first child is an interface belongs to ros2_control or a transmission.
        tag = rf"<{tag}\b[^>]*>(?!\s*<(?:command_interface|state_interface|hardwareInterface)\b)"
        names = [
            (name, macro)
            for macro, found in _in_macros(tag, every)
            for name in re.findall(r"\bname\s*=\s*[\"']([^\"']*)", found)[:1]
        ]
        literal = frozenset(name for name, _ in names if "$" not in name)
        names = [each for each in names if "$" in each[0]]
        if not names:
            return literal, []
        calls: Calls = {}
        for macro, text in _in_macros(_CALL, every):
            called = re.split(r"[\s/>]", text.partition(":")[2], maxsplit=1)[0].rpartition(".")[2]
            calls.setdefault(called, []).append((macro, text))
        for macro, text in _in_macros(_DEFAULTS, every):
            calls.setdefault(macro, []).append((macro, text))
        properties: Calls = {}
        for macro, text in _in_macros(_PROPERTY, every):
            found = [
                re.search(rf"\b{key}\s*=\s*(?:\"([^\"]*)\"|'([^']*)')", text) for key in ("name", "(?:value|default)")
            ]
            name, value = ((each[1] or each[2] or "") if each is not None else _UNKNOWN for each in found)
            properties.setdefault(name, []).append((value, macro))
        return literal, [_pattern(*name, calls, properties) for name in dict.fromkeys(names)]

    @cached_property
    def _own(self) -> dict[str, str]:
        """The files that the robot includes: path → text."""
        return {str(Path(file).absolute()): written.text for file, written in self._expanded.sources.items()}

    @cached_property
    def _texts(self) -> dict[str, str]:
        from urdfkit.description.packages.related_files import dependencies_in, manifest, neighbours, package_of
        from urdfkit.lint.project.description_files import SUFFIXES, descriptions

        near = neighbours(self._package) if self._package is not None else {}
        folders: set[Path] = set()
        for file in self._related_files:
            package = package_of(Path(file))
            if package is not None:
                folders |= {package, *(near[name] for name in dependencies_in(manifest(package)) if name in near)}
        for folder in folders:
            self._expanded.packages.watch(folder, *SUFFIXES)
        return {str(path.absolute()): text for folder in sorted(folders) for path, text in descriptions(folder)}


def _in_macros(pattern: str, texts: str) -> list[tuple[str, str]]:
    """Return each match of a pattern, after the name of the macro around it; an empty name if that is unclear."""
    bounds = [(macro.start(), macro[1] or "") for macro in re.finditer(_MACRO, texts)]
    starts = [start for start, _ in bounds]
    found = []
    for match in re.finditer(pattern, texts):
        at = bisect_right(starts, match.start()) - 1
        found.append((bounds[at][1] if at >= 0 else "", match[0]))
    return found


def _pattern(name: str, macro: str, calls: Calls, properties: Calls, outer: tuple[tuple[str, str], ...] = ()) -> str:
    """Return the pattern of a name; the arguments of the macro's calls replace its parameters, and values properties.

    Args:
        name: a name with expressions.
        macro: the macro that the name is in. If its own calls have no value, that of its caller may be visible.
        calls: the calls of macros and the defaults of their parameters.
        properties: the values of properties, each with the macro that sets it.
        outer: the parameters and properties that are being replaced, each after the macro that uses it.
    """
    parts = []
    for part in re.split(r"(\$\([^()]*\)|\$\{[^{}]*\})", name):
        if not part.startswith("$"):
            parts.append(re.escape(part))
            continue
        word = re.fullmatch(r"\$\{\s*(\w+)\s*\}", part)
        is_static = "call" not in calls  # else <xacro:call> may call any macro
        values = _values(word[1], calls.get(macro, ())) if word and is_static else set()
        if word and not values:
            values = _values(word[1], [call for each in calls.values() for call in each])
        values |= set(properties.get(word[1], ())) if word else set()
        is_written = values and len(values) <= _MAX_VALUES and not any("^" in value for value, _ in values)
        if word is None or not is_written or (macro, word[1]) in outer or len(outer) >= _MAX_DEPTH:
            parts.append(".*")
            continue
        patterns = sorted({_pattern(*value, calls, properties, (*outer, (macro, word[1]))) for value in values})
        parts.append(".*" if ".*" in patterns else f"(?:{'|'.join(patterns)})")
    pattern = "".join(parts)
    return ".*" if "\\$" in pattern or len(pattern) > _MAX_LENGTH else pattern


def _values(name: str, calls: Iterable[tuple[str, str]]) -> set[tuple[str, str]]:
    """Return the values of a parameter in calls, each with the macro that the call is in."""
    argument = re.compile(rf"(?<![\w:]){name}\s*:?=\s*[\"']?([^\"'\s]*)")
    return {(value, macro) for macro, call in calls for value in argument.findall(call)}


Calls = dict[str, list[tuple[str, str]]]
"""Name of a macro → its calls and the defaults of its parameters, each after the macro that it is in.

Name of a property → its values, each before the macro that it is in.
"""

_MACRO = r"<xacro:macro\b[^<>]*?\bname\s*=\s*[\"']([^\"']*)|</xacro:macro>"
_CALL = r"<xacro:(?!macro\b|property\b|arg\b|include\b|if\b|unless\b)[^<>]*>"
_PROPERTY = r"<(?:xacro:)?property\b(?:[^<>\"']|\"[^\"]*\"|'[^']*')*>"
_DEFAULTS = r"\bparams\s*=\s*(?:\"[^\"]*\"|'[^']*')"
"""Starts and ends of macros, calls of macros, properties, and the defaults of parameters."""

_UNKNOWN = "${}"
"""Value of a property that is an element."""

_MAX_VALUES = 200
"""Maximum number of values of one parameter."""

_MAX_DEPTH = 2
"""Maximum number of macros through which a parameter is followed."""

_MAX_LENGTH = 20_000
"""Maximum length of the pattern of one name; longer ones match every name."""
