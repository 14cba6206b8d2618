"""Directives of xacro that are misspelt, and their attributes: what they must mean."""

import re
from collections.abc import Iterator
from functools import lru_cache

from urdfkit.defect_message import Suggestion
from urdfkit.description.xacro.evaluation.tree import Tag
from urdfkit.description.xacro.faults import Fault
from urdfkit.description.xacro.recovery.missing_prefix import FOREIGN, is_directive, names_above, rename, tags_below
from urdfkit.description.xml.known_tags import TAGS

ATTRIBUTES: dict[str, tuple[str, ...]] = {
    "macro": ("name", "params"),
    "property": ("name", "value", "default", "remove", "scope", "lazy_eval"),
    "include": ("filename", "ns", "optional"),
    "arg": ("name", "default"),
    "if": ("value",),
    "unless": ("value",),
    "insert_block": ("name",),
}
"""Directive → its attributes (xacro 2.1, `check_attrs`)."""

_MEANT = {
    "arg": dict.fromkeys(("value", "val"), "default"),
    "property": dict.fromkeys(("val",), "value"),
    "include": dict.fromkeys(("file", "path", "src", "href"), "filename"),
    "macro": dict.fromkeys(("args", "arguments", "param", "parameters"), "params"),
    "insert_block": dict.fromkeys(("block",), "name"),
}
"""Directive → what other formats and functions call an attribute of it, and its name."""

_OTHERS = frozenset(("attribute", "call", "element"))
_CUTOFF = 0.8


def repair_spelling(document: Tag) -> Iterator[Fault]:
    """Correct misspelt directives and their attributes; yield a fault for each.

    Args:
        document: changed in place.
    """
    for element, tag, meant in misspelt(document):
        what = f"macro `{tag[6:]}` is not defined" if tag.startswith("xacro:") else f"<{tag}> is not an xacro element"
        message = what + Suggestion(f"{'' if tag.startswith('xacro:') else 'xacro:'}{meant}")
        yield Fault("misspelt-directive", message, element.position, name=meant)
        rename(element, meant)
    for element in list(tags_below(document)):
        directive = element.tag.removeprefix("xacro:")
        if directive in ATTRIBUTES and directive != element.tag:
            yield from _repair_attributes(element, directive)


def _repair_attributes(element: Tag, directive: str) -> Iterator[Fault]:
    for name, right in misspelt_attributes(element, directive):
        hint = Suggestion(right)
        message = f"<{element.tag}> has no attribute `{name}`" + hint
        yield Fault("directive-attribute", message, element.position, attribute=name, name=right)
        if right is not None:
            element.attributes[right] = element.attributes[name]
        del element.attributes[name]
    written = element.attributes.get("params", "") if directive == "macro" else ""
    separated = _separated(written)
    if separated != written:
        message = f"parameters of a macro are separated by spaces: `{written[:80]}`"
        details = {"value": separated}
        yield Fault("directive-attribute", message, element.position, attribute="params", details=details)
        element.attributes["params"] = separated


def misspelt(document: Tag) -> Iterator[tuple[Tag, str, str]]:
    """Yield the directives of a document whose name is misspelt, with the written and the correct name.

    A name is a misspelt directive only if the attributes fit and the document defines no macro of that name.

    Args:
        document: may be changed while it is gone through.
    """
    every = list(tags_below(document))
    macros: set[str] | None = None
    for element in every:
        tag = element.tag
        name = tag.removeprefix("xacro:")
        if name in _OTHERS or ":" in name or (name == tag and (name in TAGS or is_directive(name, element.attributes))):
            continue
        if name in ATTRIBUTES and (name != tag or not FOREIGN.isdisjoint(names_above(element))):
            continue
        meant = _near(name, tuple(ATTRIBUTES))
        if meant is None or not _fits(meant, element, name != tag):
            continue
        if macros is None:
            macros = {one.attributes.get("name", "") for one in every if one.tag in ("xacro:macro", "macro")}
        if name not in macros:
            yield element, tag, meant


def misspelt_attributes(element: Tag, directive: str) -> Iterator[tuple[str, str | None]]:
    """Yield the attributes that a directive does not have, with the correct name, or None if no name is near.

    Args:
        element: may be changed while its attributes are gone through.
        directive: its name, without prefix.
    """
    allowed = ATTRIBUTES[directive]
    for name in list(element.attributes):
        if name in allowed or name.startswith(("xmlns", "xacro:")):
            continue
        free = tuple(one for one in allowed if one not in element.attributes)
        meant = _MEANT.get(directive, {}).get(name.lower())
        meant = meant if meant in free else _near(name, free)
        if meant is not None or directive != "include":  # parameters of an include are another matter
            yield name, meant


def _separated(parameters: str) -> str:
    """Return the parameters of a macro with blanks in place of commas; what may belong to a default is left alone."""
    if not ("," in parameters or ";" in parameters) or any(mark in parameters for mark in "'\"[({"):
        return parameters
    between = r"[ \t]*[,;](?=\s)|[ \t]*[,;](?=\*|\w+\s*:?=)|[ \t]*[,;]\s*$"
    if ":" not in parameters and "=" not in parameters:
        between = r"[ \t]*[,;]"
    parts = re.sub(between, " ", parameters)
    return re.sub(r"(?<=\S) {2,}", " ", parts).rstrip() if not ("," in parts or ";" in parts) else parameters


@lru_cache(maxsize=1_000)
def _near(name: str, candidates: tuple[str, ...]) -> str | None:
    if len(name) < 4:
        return None
    for candidate in candidates:
        if sorted(candidate) == sorted(name.lower()):
            return candidate
    lower = name.lower()
    if not any(_may_be_near(lower, candidate) for candidate in candidates):
        return None  # Nearly always; difflib takes a while to load.
    from difflib import get_close_matches

    return next(iter(get_close_matches(lower, candidates, n=1, cutoff=_CUTOFF)), None)


def _may_be_near(name: str, candidate: str) -> bool:
    """Whether two names have so many letters in common that difflib may find them alike enough."""
    shared = sum(min(name.count(letter), candidate.count(letter)) for letter in set(name))
    return 2.0 * shared >= _CUTOFF * (len(name) + len(candidate))


def _fits(directive: str, element: Tag, is_prefixed: bool) -> bool:
    """Whether an element has the attributes of the directive, and no others."""
    attributes = element.attributes
    allowed = ATTRIBUTES[directive]
    if not all(name in allowed or name.startswith("xmlns") or _near(name, allowed) for name in attributes):
        return False
    if directive == "property":
        return "name" in attributes and (is_prefixed or len(attributes) > 1)
    if directive == "macro":
        return "name" in attributes and ("params" in attributes or is_prefixed)
    return allowed[0] in attributes and (is_prefixed or directive == "include")
