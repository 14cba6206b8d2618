"""From an exception of xacro to a `Fault`: what is wrong, where a person wrote it, and the nearest right thing."""

from __future__ import annotations

import re

from urdfkit.description.packages.resolver import near_path
from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xacro.xacro_frames import Place, place_of_error
from urdfkit.description.xml.reader import document_of, shown_path
from urdfkit.description.xml.source import Expansion, Position
from urdfkit.errors import ResourceError, UrdfkitError, XacroError, XmlError, did_you_mean

TYPE_CHECKING = False
if TYPE_CHECKING:
    from types import FrameType
    from typing import Any

    from urdfkit.description.xacro.expansion import Run

_DIRECTIVES = ("arg", "attribute", "call", "element", "if", "include", "insert_block", "macro", "property", "unless")
_UNDEFINED_NAME = r"name '([^']*)' is not defined"
_UNKNOWN_MACRO = r"unknown macro name: xacro:(\S+)"
_UNDEFINED_PARAMETERS = r"Undefined parameters \[(.*)\]"
_INVALID_PARAMETER = r'Invalid parameter "(.*)"'
_BLOCK = r'Undefined block "(.*)"'
_UNUSED_BLOCK = r'Unused block "(.*)"'
_CONDITIONAL = r'Xacro conditional "(.*)" evaluated to "(.*)", which'
_CIRCULAR = r"circular variable definition: ([^\n]*)"
_FORWARDED = r"Undefined property to forward: (\S+)"
_MISSING_ATTRIBUTE = r"(?<!\S)(\S+): missing attribute '(.*)'"


def fault_of(error: BaseException, run: Run, caught_in: FrameType | None = None) -> Fault:
    """Diagnose what xacro raised.

    Args:
        error: the exception, with its traceback.
        run: the run it was raised in.
        caught_in: the frame that caught it, when xacro is still running below.
    """
    if isinstance(error, XmlError) and error.position is not None:
        return Fault("xml", error.message, error.position, details={"cause": error.cause})
    place = place_of_error(error, caught_in)
    position, expansions, attribute = run.where(place)
    facts = _facts(error, place, run)
    if facts["kind"] == "too-many" and expansions:
        # Which of the multitude was the last is of no interest: it is the call that a person can change.
        position, expansions, attribute = expansions[-1].position, (), None
    if facts["kind"] == "recursion":
        expansions = expansions[: len(facts.get("details", {}).get("cycle", ()))]
    return Fault(position=position, expansions=expansions, attribute=attribute, expression=place.expression, **facts)


def error_of(error: BaseException, run: Run) -> UrdfkitError:
    """Turn what xacro raised into the one line for the user.

    Args:
        error: the exception, with its traceback.
        run: the run it was raised in.
    """
    if isinstance(error, UrdfkitError):
        return error
    if isinstance(error, OSError):
        return ResourceError(f"cannot read {run.path}: {error.strerror or error}")
    fault = fault_of(error, run)
    message = fault.message
    if fault.kind in ("undefined-property", "undefined-macro") and fault.name is not None:
        later = defined_in(run, fault.kind, fault.name)
        if later is not None:
            message = f"{message.split('; did you mean')[0]} yet: its definition follows at {later}"
    chain = "" if fault.kind == "recursion" else chain_words(fault.expansions)
    return XacroError(message + chain, position=fault.position)


def undefined_property(name: str, place: Place) -> dict[str, Any]:
    """Return the facts of a `Fault` about an undefined property."""
    candidates = tuple(place.names())
    hint = did_you_mean(name, (*candidates, "pi", "tau", "radians", "degrees", "sin", "cos", "tan", "sqrt"))
    return {
        "kind": "undefined-property",
        "message": f"property `{name}` is not defined{hint}",
        "name": name,
        "candidates": candidates,
    }


def undefined_macro(name: str, place: Place) -> dict[str, Any]:
    """Return the facts of a `Fault` about an undefined macro."""
    candidates = tuple(place.macro_names())
    return {
        "kind": "undefined-macro",
        "message": f"macro `{name}` is not defined{did_you_mean(name, (*candidates, *_DIRECTIVES))}",
        "name": name,
        "candidates": candidates,
    }


def macro_arguments(macro: str, missing: tuple[str, ...], unknown: tuple[str, ...], known: list[str]) -> dict[str, Any]:
    """Return the facts of a `Fault` about a call that does not fit its macro."""
    if unknown:
        wrong = f"has no parameter {_listed(unknown)}{did_you_mean(unknown[0], known)}"
    else:
        wrong = f"needs {_listed(missing)}"
    return {
        "kind": "macro-arguments",
        "message": f"macro `{macro}` {wrong}",
        "name": macro,
        "candidates": tuple(known),
        "details": {"macro": macro, "missing": missing, "unknown": unknown},
    }


def defined_in(run: Run, kind: str, name: str) -> Position | None:
    """Return where the files read so far define a property or macro, whether it was in time or not."""
    tags = ("xacro:property", "property") if kind == "undefined-property" else ("xacro:macro", "macro")
    for source in run.sources.values():
        try:
            root = document_of(source)
        except XmlError:
            continue
        for element in root.walk():
            if element.tag in tags and element.get("name") == name:
                return element.origin.position
    return None


def chain_words(expansions: tuple[Expansion, ...]) -> str:
    """Return the chain of macro calls in a few words, innermost first."""
    if not expansions:
        return ""
    shown = [f"`{expansion.macro}` called at {expansion.position}" for expansion in expansions[:3]]
    more = f" and {len(expansions) - 3} more" if len(expansions) > 3 else ""
    return f" (in {', in '.join(shown)}{more})"


def _facts(error: BaseException, place: Place, run: Run) -> dict[str, Any]:
    causes = _causes(error)
    root = causes[-1]
    text = root.msg if isinstance(root, SyntaxError) else str(root)
    name = type(root).__name__
    if name == "TooMany":
        return {"kind": "too-many", "message": text}
    if name == "TooLarge":
        return {"kind": "too-large", "message": _too_large(text, place)}
    if name == "Endless":
        return _endless(root)
    if isinstance(root, RecursionError):
        return {"kind": "recursion", "message": "calls of macros, includes and properties are nested too deeply"}
    if isinstance(root, ResourceError):
        return {"kind": "package-not-found", "message": root.message, "name": run.missing_package}
    if isinstance(root, OSError):
        return _unreadable(root, place)
    if name == "ArgException":
        known = tuple(run.xacro.substitution_args_context["arg"])
        hint = did_you_mean(text, known) or f"; give it as {text}:=value or a default with <xacro:arg>"
        message = f"argument `{text}` has no value{hint}"
        return {"kind": "undefined-arg", "message": message, "name": text, "candidates": known}
    if isinstance(root, NameError) and (found := re.search(_UNDEFINED_NAME, text)):
        return undefined_property(found[1], place)
    for pattern, facts in _BY_TEXT:
        if found := re.search(pattern, text, re.DOTALL):
            return facts(found, place, root)
    if place.expression is not None:
        message = f"cannot evaluate `${{{_short(place.expression)}}}`: {_short(text)}"
        return {"kind": "bad-expression", "message": message}
    if place.command is not None:
        message = f"cannot evaluate `$({_short(place.command)})`: {_short(text)}"
        return {"kind": "bad-expression", "message": message}
    return {"kind": "other", "message": _short(text) or name}


def _too_large(text: str, place: Place) -> str:
    if place.expression is not None:
        return f"`${{{_short(place.expression)}}}` is too large: {text}"
    return f"`$({_short(place.command)})` is too large: {text}" if place.command is not None else f"too large: {text}"


def _endless(root: Any) -> dict[str, Any]:
    if root.what == "file":
        message = f"files include each other in a cycle: {' → '.join(root.cycle)}"
    else:
        message = f"macro `{root.cycle[-1]}` calls itself in an infinite recursion: {' → '.join(root.cycle)}"
    return {"kind": "recursion", "message": message, "details": {"cycle": root.cycle}}


def _unreadable(root: OSError, place: Place) -> dict[str, Any]:
    import errno
    from pathlib import Path

    path = Path(str(root.filename or ""))
    if root.errno == errno.ENAMETOOLONG:
        why = "has a name that is too long"
    elif path.is_dir():
        why = "is a folder"
    else:
        why = f"{'cannot be read' if path.is_file() else 'does not exist'}{near_path(path)}"
    is_include = place.node is not None and place.node.tagName == "xacro:include"
    return {
        "kind": "include-not-found" if is_include else "other",
        "message": f"{'included ' if is_include else ''}file {shown_path(path)} {why}",
        "name": shown_path(path),
        "details": {"path": str(path)},
    }


def _unknown_macro(found: re.Match[str], place: Place, _: Any) -> dict[str, Any]:
    return undefined_macro(found[1], place)


def _missing_parameters(found: re.Match[str], place: Place, root: Any) -> dict[str, Any]:
    macro = root.macros[0]
    return macro_arguments(macro.body.getAttribute("name"), tuple(found[1].split(",")), (), list(macro.params))


def _unknown_parameter(found: re.Match[str], place: Place, root: Any) -> dict[str, Any]:
    macro = root.macros[0]
    return macro_arguments(macro.body.getAttribute("name"), (), (found[1],), list(macro.params))


def _undefined_block(found: re.Match[str], place: Place, _: Any) -> dict[str, Any]:
    known = tuple(
        key.lstrip("*") for table in _tables(place.symbols) for key in dict.keys(table) if key.startswith("*")
    )
    message = f"block `{found[1]}` is not defined{did_you_mean(found[1], known)}"
    return {"kind": "undefined-block", "message": message, "name": found[1], "candidates": known}


def _unused_block(found: re.Match[str], place: Place, root: Any) -> dict[str, Any]:
    macro = root.macros[0].body.getAttribute("name")
    return {
        "kind": "macro-arguments",
        "message": f"macro `{macro}` accepts no further block `<{found[1]}>`",
        "name": macro,
    }


def _too_few_blocks(_: re.Match[str], place: Place, root: Any) -> dict[str, Any]:
    macro = root.macros[0].body.getAttribute("name")
    return {"kind": "macro-arguments", "message": f"macro `{macro}` needs more blocks inside its call", "name": macro}


def _not_boolean(found: re.Match[str], place: Place, _: Any) -> dict[str, Any]:
    message = f"condition `{_short(found[1])}` is `{_short(found[2])}`, neither true nor false"
    return {"kind": "conditional", "message": message}


def _circular(found: re.Match[str], place: Place, _: Any) -> dict[str, Any]:
    cycle = tuple(found[1].split(" -> "))
    message = f"property `{cycle[-1]}` is defined in terms of itself: {' → '.join(cycle)}"
    return {"kind": "recursion", "message": message, "name": cycle[-1], "details": {"cycle": cycle}}


def _forwarded(found: re.Match[str], place: Place, _: Any) -> dict[str, Any]:
    return undefined_property(found[1], place)


def _missing_attribute(found: re.Match[str], place: Place, _: Any) -> dict[str, Any]:
    message = f"<{found[1]}> lacks its attribute `{found[2]}`"
    return {"kind": "other", "message": message, "name": found[2]}


_BY_TEXT = (
    (_UNKNOWN_MACRO, _unknown_macro),
    (_UNDEFINED_PARAMETERS, _missing_parameters),
    (_INVALID_PARAMETER, _unknown_parameter),
    (_BLOCK, _undefined_block),
    (_UNUSED_BLOCK, _unused_block),
    ("Not enough blocks", _too_few_blocks),
    (_CONDITIONAL, _not_boolean),
    (_CIRCULAR, _circular),
    (_FORWARDED, _forwarded),
    (_MISSING_ATTRIBUTE, _missing_attribute),
)


def _causes(error: BaseException) -> list[BaseException]:
    found = [error]
    while isinstance(cause := getattr(found[-1], "exc", None), BaseException) and cause not in found:
        found.append(cause)
    return found


def _tables(table: Any) -> list[Any]:
    found = []
    while table is not None and hasattr(table, "parent"):
        found.append(table)
        table = table.parent
    return found


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 120 else line[:119] + "…"
