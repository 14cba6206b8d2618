"""Failures: what cannot be expanded, as an exception with the facts of a `Fault`."""

from __future__ import annotations

from collections.abc import Iterable
from types import MappingProxyType

from urdfkit.defect_message import DefectMessage, Suggestion
from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Expansion, Position, Source
from urdfkit.errors import XacroError, XmlError, did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.description.xacro.evaluation.tree import Tag

Place = tuple["Tag | SourceElement | None", "str | None"]
"""An element and one of its attributes; None for text, or for the element as a whole."""


class SourceElement:
    """An element that a person wrote, in the macro calls that use it.

    Attributes:
        position: of its start tag.
        chain: the macro calls, innermost first.
    """

    __slots__ = ("chain", "position")

    def __init__(self, position: Position, chain: tuple[Expansion, ...]) -> None:
        self.position, self.chain = position, chain


DIRECTIVES = ("arg", "attribute", "call", "element", "if", "include", "insert_block", "macro", "property", "unless")

_ELSEWHERE = {
    **{"true": "True", "false": "False", "unicode": "str", "long": "int", "xrange": "python.range"},
    **{name: f"python.{name}" for name in ("abs", "all", "any", "enumerate", "filter", "set", "sum", "tuple", "zip")},
    **{name: f"xacro.{name}" for name in ("arg", "tokenize")},
}
"""Names of Python, also of Python 2, and functions of xacro, by the name that expressions of xacro 2.1 use."""


class Failure(Exception):  # noqa: N818 - a fault of the file, reported as such
    """An element or expression of a file cannot be expanded.

    Args:
        kind: of the fault.
        message: one line for the user.
        facts: further attributes of the `Fault`.

    Attributes:
        place: where it is written; set by the evaluator.
        is_missing_file: whether an ``include`` with ``optional`` may pass over it.
        loop: what repeats without end: ``macro``, ``file`` or ``block``.
    """

    def __init__(self, kind: Any, message: str, **facts: Any) -> None:
        super().__init__(message)
        self.kind, self.message, self.facts = kind, message, facts
        self.place: Place | None = None
        self.is_missing_file = False
        self.loop = ""

    def fault(self) -> Fault:
        """Return the record of it; its place has to be names."""
        tag, attribute = self.place or (None, None)
        assert tag is not None
        position, expansions = tag.position, tag.chain
        if self.kind == "too-many" and expansions:
            position, expansions, attribute = expansions[-1].position, (), None
        if self.kind == "recursion":
            expansions = expansions[: len(self.facts.get("details", {}).get("cycle", ()))]
        facts = {"details": MappingProxyType({}), **self.facts}
        return Fault(self.kind, self.message, position, expansions, attribute, **facts)


def undefined_property(name: str, candidates: Iterable[str]) -> Failure:
    """Return the failure for a property that is not defined."""
    names = tuple(candidates)
    constants = ("pi", "tau", "radians", "degrees", "sin", "cos", "tan", "sqrt")
    meant = _ELSEWHERE.get(name)
    hint = Suggestion(meant, name) if meant else did_you_mean(name, (*names, *constants))
    return Failure("undefined-property", f"property `{name}` is not defined" + hint, name=name, candidates=names)


def undefined_default(name: str, macro: str, candidates: Iterable[str]) -> Failure:
    """Return the failure for a call without a parameter whose default is the property of the same name (``:=^``)."""
    failure = undefined_property(name, candidates)
    failure.message = f"macro `{macro}` needs `{name}` or a property of that name: " + failure.message
    return failure


def undefined_in_command(name: str, arguments: tuple[str, ...]) -> Failure:
    """Return the failure for a name in ``$(eval …)`` that is not defined."""
    message = f"`{name}` in $(eval …) is neither an argument nor a function" + did_you_mean(name, arguments)
    return Failure("undefined-arg", message, name=name, candidates=arguments)


def undefined_macro(name: str, candidates: Iterable[str]) -> Failure:
    """Return the failure for a macro that is not defined."""
    names = tuple(candidates)
    hint = did_you_mean(name, (*names, *DIRECTIVES))
    return Failure("undefined-macro", f"macro `{name}` is not defined" + hint, name=name, candidates=names)


def macro_arguments(macro: str, missing: tuple[str, ...], unknown: tuple[str, ...], names: list[str]) -> Failure:
    """Return the failure for a call that does not fit its macro."""
    if unknown:
        wrong = f"has no parameter {_listed(unknown)}" + did_you_mean(unknown[0], names)
    else:
        wrong = f"needs {_listed(missing)}"
    details = {"macro": macro, "missing": missing, "unknown": unknown}
    message = f"macro `{macro}` " + wrong
    return Failure("macro-arguments", message, name=macro, candidates=tuple(names), details=details)


def undefined_block(name: str, candidates: Iterable[str]) -> Failure:
    """Return the failure for a block that is not defined."""
    names = tuple(candidates)
    message = f"block `{name}` is not defined" + did_you_mean(name, names)
    return Failure("undefined-block", message, name=name, candidates=names)


def circular_property(cycle: tuple[str, ...]) -> Failure:
    """Return the failure for a property whose value needs itself."""
    message = f"property `{cycle[-1]}` is defined in terms of itself: {' → '.join(cycle)}"
    return Failure("recursion", message, name=cycle[-1], details={"cycle": cycle})


def cycle(names: list[str]) -> tuple[str, ...]:
    """Return the last cycle of a stack of names, first name repeated; the names above it are ignored."""
    for end in range(len(names), 1, -1):
        last = names[end - 1]
        for start in range(end - 2, -1, -1):
            if names[start] == last:
                return tuple(names[start:end])
    return tuple(names[-3:])


def recursive_macro(cycle: tuple[str, ...]) -> Failure:
    """Return the failure for macros that call each other without end."""
    message = f"macro `{cycle[-1]}` calls itself in an infinite recursion: {' → '.join(cycle)}"
    return _loop("macro", message, cycle)


def recursive_block(cycle: tuple[str, ...]) -> Failure:
    """Return the failure for blocks that insert each other without end."""
    message = f"block `{cycle[-1]}` inserts itself in an infinite recursion: {' → '.join(cycle)}"
    return _loop("block", message, cycle)


def recursive_include(cycle: tuple[str, ...]) -> Failure:
    """Return the failure for files that include each other without end."""
    message = f"files include each other in a cycle: {' → '.join(cycle)}"
    return _loop("file", message, cycle)


def _loop(what: str, message: str, cycle: tuple[str, ...]) -> Failure:
    failure = Failure("recursion", message, details={"cycle": cycle})
    failure.loop = what
    return failure


def error_of(failure: Failure, sources: Iterable[Source]) -> XacroError:
    """Return the error of a strict expansion.

    Args:
        failure: what stopped it.
        sources: the files that were read, to find a definition that comes too late.
    """
    fault = failure.fault()
    message = fault.message
    if fault.kind in ("undefined-property", "undefined-macro") and fault.name is not None:
        later = definition(sources, fault.kind.removeprefix("undefined-"), fault.name)
        if later is not None:
            at = fault.position
            follows = at is not None and at.file == later.file and (at.line, at.column) < (later.line, later.column)
            where = f"yet: its definition follows at {later}" if follows else f"here: it is defined at {later}"
            message = f"{DefectMessage.of(message).stem} {where}"
    chain = "" if fault.kind == "recursion" else chain_words(fault.expansions)
    return XacroError(message + chain, position=fault.position)


def definition(sources: Iterable[Source], tag: str, name: str) -> Position | None:
    """Return where files first define a property or macro, in time or not."""
    for source in sources:
        try:
            root = document_of(source)
        except XmlError:
            continue
        for element in root.walk():
            if element.tag in (tag, f"xacro:{tag}") and element.get("name") == name:
                return element.origin.position
    return None


def chain_words(expansions: tuple[Expansion, ...]) -> str:
    """Return the chain of macro calls as text, innermost first."""
    if not expansions:
        return ""
    shown = [f"`{expansion.macro}` called at {expansion.position}" for expansion in expansions[:3]]
    more = f" and {len(expansions) - 3} more" if len(expansions) > 3 else ""
    return f" (in {', '.join(shown)}{more})"


def short(text: str) -> str:
    """Return a text in one line of at most 120 characters."""
    line = " ".join(text.split())
    return line if len(line) <= 120 else line[:119] + "…"


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)
