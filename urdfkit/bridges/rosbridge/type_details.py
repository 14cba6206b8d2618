"""Definitions of message types as ``rosapi`` returns them: fields, their types, and the lengths of arrays."""

from typing import Any

from urdfkit.errors import UsageError, did_you_mean
from urdfkit.messages import full_type_name, typestore

NO_ARRAY = -1
ANY_LENGTH = 0
EXAMPLES = {"string": "", "wstring": "", "bool": "False", "float32": "0.0", "float64": "0.0"}


def type_details(type: str) -> list[dict[str, Any]]:
    """Return the definition of a message type and those of its fields, each once.

    Raises:
        UsageError: the type is unknown.
    """
    layouts = typestore().fielddefs
    first = full_type_name(type)
    if first not in layouts:
        raise UsageError(f"no message type `{type}`{did_you_mean(first, layouts)}")
    found: dict[str, dict[str, Any]] = {}
    waiting = [first]
    while waiting:
        name = waiting.pop(0)
        if name in found:
            continue
        constants, fields = layouts[name]
        details: dict[str, list[Any]] = {"fieldnames": [], "fieldtypes": [], "fieldarraylen": [], "examples": []}
        for field, (node, description) in fields:
            if field == "structure_needs_at_least_one_member":
                continue
            inner, length = _element(int(node), description)
            if inner in layouts:
                waiting.append(inner)
            details["fieldnames"].append(field)
            details["fieldtypes"].append(inner.replace("/msg/", "/"))
            details["fieldarraylen"].append(length)
            example = "{}" if inner in layouts else EXAMPLES.get(inner, "0")
            details["examples"].append(example if length == NO_ARRAY else "[]")
        found[name] = {
            "type": name.replace("/msg/", "/"),
            **details,
            "constnames": [each[0] for each in constants],
            "constvalues": [str(each[2]) for each in constants],
        }
    return list(found.values())


def _element(node: int, description: Any) -> tuple[str, int]:
    """Return the type of a field, or of the entries of an array, and the length of the array."""
    if node == 1:
        return description[0], NO_ARRAY
    if node == 2:
        return description, NO_ARRAY
    inner, _ = _element(int(description[0][0]), description[0][1])
    return inner, description[1] if node == 3 else ANY_LENGTH
