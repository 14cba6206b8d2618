"""Calls of macros that do not fit: which macro is meant, and what is too much or too little for it."""

from __future__ import annotations

from urdfkit.description.xacro.faults import Fault

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from typing import Any
    from xml.dom import minidom

    from urdfkit.description.xml.source import Expansion, Position

    PositionOf = Callable[[minidom.Element], tuple[Position, tuple[Expansion, ...]]]

LEFT_OUT = "\0left out: "
"""Marks the value of a parameter that a call left out; cannot occur in XML."""


def near_macro(name: str, macros: Iterable[str]) -> list[str]:
    """Return the macros that a name nearly is, the nearest first."""
    from difflib import get_close_matches

    pool = {macro.lower(): macro for macro in macros}
    return [pool[near] for near in get_close_matches(name.lower(), pool, n=3, cutoff=0.75)]


def is_call_of(macro: Any, node: Any) -> bool:
    """Whether an element gives what a macro takes, and nothing else: each of its parameters and blocks."""
    given = set(node.attributes.keys()) if node is not None and node.attributes else set()
    required = {name for name in macro.params if not name.startswith("*") and name not in macro.defaultmap}
    blocks = sum(name.startswith("*") for name in macro.params)
    inside = sum(child.nodeType == child.ELEMENT_NODE for child in node.childNodes) if node is not None else 0
    return required <= given <= set(macro.params) and inside == blocks


def fitted(node: minidom.Element, macro: Any, position_of: PositionOf) -> Iterator[Fault]:
    """Take away what a macro has no parameter for, mark what its call leaves out, and yield what was wrong.

    Args:
        node: the call; it is changed.
        macro: what xacro has as the macro.
        position_of: returns where an element was written, and its chain of calls.
    """
    given = list(node.attributes.keys())
    unknown = tuple(name for name in given if name not in macro.params)
    for name in unknown:
        node.removeAttribute(name)
    missing = tuple(
        name for name in macro.params if not name.startswith("*") and name not in (*macro.defaultmap, *given)
    )
    for name in missing:
        node.setAttribute(name, LEFT_OUT + name)
    wrong = [((), (name,)) for name in unknown] + ([(missing, ())] if missing else [])
    for left_out, odd in wrong:
        position, expansions = position_of(node)
        from urdfkit.description.xacro.diagnosis import macro_arguments  # most calls fit

        facts = macro_arguments(macro.body.getAttribute("name"), left_out, odd, list(macro.params))
        attribute = odd[0] if odd else None
        yield Fault(position=position, expansions=expansions, attribute=attribute, **facts)
