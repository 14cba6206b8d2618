"""Messages as JSON, as rosbridge defines it: bytes in base64, null for numbers that JSON lacks."""

import base64
import binascii
import json
import math
from functools import cache
from typing import Any

import numpy as np

from urdfkit.errors import UsageError
from urdfkit.messages import from_fields, full_type_name, typestore
from urdfkit.messages.conversion import field_names


def to_json(value: Any) -> str:
    """Return a message, or the value of a field, as JSON."""
    if type(value) is float:  # most fields
        return repr(value) if math.isfinite(value) else "null"
    if isinstance(value, np.ndarray):
        return _array(value)
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, bool | np.bool_):
        return "true" if value else "false"
    if isinstance(value, int | np.integer):
        return str(int(value))
    if isinstance(value, float | np.floating):
        return repr(float(value)) if math.isfinite(value) else "null"
    if isinstance(value, list | tuple):
        return "[" + ",".join(map(to_json, value)) + "]"
    return "{" + ",".join([f"{label}{to_json(getattr(value, name))}" for label, name in _labels(value.__class__)]) + "}"


@cache
def _labels(kind: Any) -> tuple[tuple[str, str], ...]:
    """Return the beginning of each field in JSON, and its name."""
    return tuple((f'"{name}":', name) for name in field_names(kind))


def json_values(message: Any) -> Any:
    """Return a message as values of JSON: objects, lists, texts, numbers."""
    return json.loads(to_json(message))


def _array(values: Any) -> str:
    if values.dtype == np.uint8:
        return f'"{base64.b64encode(values.tobytes()).decode("ascii")}"'  # needs no escapes
    items = values.tolist()
    if values.dtype.kind == "f" and not all(map(math.isfinite, items)):
        items = [item if math.isfinite(item) else None for item in items]
    return json.dumps(items, separators=(",", ":"))


def from_json(type: str, fields: Any) -> Any:
    """Return a message with these fields, the others zero or empty.

    Args:
        type: of the message.
        fields: as a peer sent them; bytes are base64, or lists of numbers; null in an array of floats is not a number.

    Raises:
        UsageError: no such type or field, or a value of the wrong kind.
    """
    full = full_type_name(type)
    try:
        return from_fields(full, _with_bytes(full, fields))
    except (ArithmeticError, RecursionError, TypeError, ValueError) as error:
        raise UsageError(f"the message is not a {full}: {error}") from error


def _with_bytes(type: str, fields: Any) -> Any:
    """Return the fields with every base64 text in the place of bytes decoded."""
    layouts = typestore().fielddefs
    if not isinstance(fields, dict) or type not in layouts:
        return fields
    layout = dict(layouts[type][1])
    return {name: _decoded(layout[name], value) if name in layout else value for name, value in fields.items()}


def _decoded(description: Any, value: Any) -> Any:
    node, details = int(description[0]), description[1]
    if node == 2:
        return _with_bytes(details, value)
    if node in (3, 4):
        inner = details[0]
        if isinstance(value, str) and int(inner[0]) == 1 and inner[1][0] in ("uint8", "octet", "byte", "char"):
            try:
                return np.frombuffer(bytearray(base64.b64decode(value, validate=True)), dtype=np.uint8)
            except binascii.Error as error:
                raise UsageError(f"a byte array is not valid base64: {error}") from error
        if isinstance(value, list) and int(inner[0]) == 1 and inner[1][0].startswith("float"):
            return [math.nan if each is None else each for each in value]
        if isinstance(value, list) and int(inner[0]) == 2:
            return [_decoded(inner, each) for each in value]
    return value
