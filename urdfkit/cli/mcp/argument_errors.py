"""Messages for arguments of a tool that its schema does not allow."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from urdfkit.errors import did_you_mean

if TYPE_CHECKING:
    from mcp.types import Tool

MAX_VALUE = 60
"""Maximum number of characters of a value in a message."""

_KINDS = {
    "number": ("a number", "numbers"),
    "integer": ("an integer", "integers"),
    "string": ("a string", "strings"),
    "boolean": ("true or false", "Boolean values"),
}


def unknown_argument(tool: Tool, arguments: dict[str, Any]) -> str | None:
    """Return the message for the first argument that a tool does not have; None without one."""
    valid = tool.input_schema.get("properties", {})
    for word in arguments:
        if word not in valid:
            hint = did_you_mean(word, valid) or f"; arguments: {', '.join(valid)}"
            return f"`{tool.name}` has no argument `{word}`{hint}"
    return None


def wrong_arguments(tool: Tool, arguments: dict[str, Any], names: list[str]) -> str:
    """Return the message for missing and wrong arguments, in one line.

    Args:
        tool: the tool.
        arguments: the values passed.
        names: the arguments that are missing or have a wrong value.
    """
    parts = []
    for name in dict.fromkeys(names):
        expected = _expected(tool.input_schema["properties"][name])
        if name not in arguments:
            parts.append(f"missing argument `{name}`, {expected}")
            continue
        value = json.dumps(arguments[name], ensure_ascii=False)
        value = value if len(value) <= MAX_VALUE else f"{value[:MAX_VALUE]}…"
        parts.append(f"`{name}` is {value}, not {expected}")
    return f"{tool.name}: {'; '.join(parts)}"


def _expected(schema: dict[str, Any]) -> str:
    """Return in words which values a schema allows, without null, which stands for an omitted argument."""
    schema = next((each for each in schema.get("anyOf", ()) if each.get("type") != "null"), schema)
    kind = schema.get("type")
    if kind == "array":
        items = schema["prefixItems"]
        return f"{len(items)} {_KINDS[items[0]['type']][1]}"
    if kind == "object":
        return f"an object of {_KINDS[schema['additionalProperties']['type']][1]}"
    return _KINDS[str(kind)][0]
