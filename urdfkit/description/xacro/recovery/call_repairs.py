"""Repair calls of misspelt macros, and calls with missing or unknown parameters."""

from collections.abc import Iterable, Iterator

from urdfkit.description.xacro.evaluation.failures import Failure, macro_arguments
from urdfkit.description.xacro.evaluation.macros import Macro
from urdfkit.description.xacro.evaluation.tree import Tag
from urdfkit.description.xacro.recovery.unknown_values import Unknown
from urdfkit.errors import similar


def near_macros(name: str, macros: Iterable[str]) -> list[str]:
    """Return the macros with a name similar to another, the most similar first."""
    by_lower_case = {macro.lower(): macro for macro in macros}
    return [by_lower_case[near] for near in similar(name.lower(), by_lower_case, count=3, cutoff=0.75)]


def is_call_of(node: Tag, macro: Macro) -> bool:
    """Whether an element passes exactly the parameters and blocks of a macro."""
    names = [parameter.name for parameter in macro.parameters]
    blocks = [name for name in names if name.startswith("*")]
    missing = _missing(node, macro)
    return not missing and node.attributes.keys() <= set(names) and sum(1 for _ in node.tags()) == len(blocks)


def fit(node: Tag, macro: Macro) -> Iterator[Failure]:
    """Remove the attributes of a call that its macro does not accept, add missing ones, and yield a failure for each.

    Args:
        node: the call; it is changed.
        macro: the macro.
    """
    assert macro.body is not None
    title, names = str(macro.body.attributes.get("name", "")), [parameter.name for parameter in macro.parameters]
    for name in [name for name in node.attributes if name not in names]:
        del node.attributes[name]
        failure = macro_arguments(title, (), (name,), names)
        failure.place = node, name
        yield failure
    if missing := _missing(node, macro):
        node.attributes.update({name: Unknown(f"${{{name}}}") for name in missing})
        failure = macro_arguments(title, missing, (), names)
        failure.place = node, None
        yield failure


def _missing(node: Tag, macro: Macro) -> tuple[str, ...]:
    """Return the parameters that a call has to pass and does not."""
    return tuple(
        parameter.name
        for parameter in macro.parameters
        if not parameter.has_default and not parameter.name.startswith("*") and parameter.name not in node.attributes
    )
