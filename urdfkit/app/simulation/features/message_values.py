"""Values of messages for the page: messages as JSON with long arrays cut, and numbers by path."""

import math
import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from urdfkit.errors import UsageError, did_you_mean
from urdfkit.messages.conversion import fields_of

LONG = 24
"""Number of entries of an array that are shown."""
PLOTTED = 64
"""Number of entries of an array that can be plotted."""
_STEP = re.compile(r"([A-Za-z_]\w*)|\[(\d{1,6})\]")


def as_json(value: Any, long: int = LONG) -> Any:
    """Return a message, or a part of one, as a JSON value.

    Args:
        value: the message.
        long: maximum number of entries of an array; a longer one is cut, followed by its length.
    """
    if isinstance(value, bool | np.bool_):
        return bool(value)
    if isinstance(value, int | np.integer):
        return int(value)
    if isinstance(value, float | np.floating):
        return float(value) if math.isfinite(value) else str(float(value))
    if isinstance(value, str):
        return value if len(value) <= 4000 else f"{value[:4000]} … {len(value)} characters"
    if isinstance(value, bytes | bytearray):
        return f"{len(value)} bytes"
    if isinstance(value, np.ndarray) and value.dtype == np.uint8 and value.size > long:
        return f"{value.size} bytes"
    if isinstance(value, np.ndarray) and (
        value.dtype.kind in "iu" or (value.dtype.kind == "f" and np.isfinite(value[:long]).all())
    ):
        shown = value[:long].tolist()
        return shown if len(value) <= long else [*shown, f"… {len(value)} in all"]
    if isinstance(value, np.ndarray | list | tuple):
        shown = [as_json(entry, long) for entry in value[:long]]
        return shown if len(value) <= long else [*shown, f"… {len(value)} in all"]
    if hasattr(value, "__msgtype__"):
        return {name: as_json(getattr(value, name), long) for name in fields_of(value)}
    return str(value)


def number_at(message: Any, path: str) -> float:
    """Return the number at a path such as ``pose.pose.position.x`` or ``position[2]``; NaN past the end of an array.

    Raises:
        UsageError: the field does not exist or is not a number; names the nearest field.
    """
    value, at = message, 0
    while at < len(path):
        found = _STEP.match(path, at)
        if found is None:
            raise UsageError(f"`{path}` is not the path of a field, such as pose.position.x or position[2]")
        name, index = found[1], found[2]
        if name is not None:
            if name not in (names := fields_of(value)):
                raise UsageError(f"unknown field `{name}` in `{path}`{did_you_mean(name, names)}")
            value = getattr(value, name)
        else:
            if not isinstance(value, np.ndarray | list | tuple):
                raise UsageError(f"`{path[:at]}` is not an array and has no entry {index}")
            if int(index) >= len(value):
                return math.nan
            value = value[int(index)]
        at = found.end()
        if at < len(path) and path[at] == ".":
            at += 1
    if isinstance(value, bool | np.bool_ | int | float | np.number):
        return float(value)
    raise UsageError(f"`{path}` is not a number")


def numbers_in(value: Any, path: str = "") -> Iterator[str]:
    """Yield the paths of all numbers in a message."""
    if isinstance(value, bool | np.bool_ | int | float | np.number):
        yield path
    elif isinstance(value, np.ndarray | list | tuple):
        if isinstance(value, np.ndarray) and value.dtype == np.uint8 and value.size > PLOTTED:
            return
        for k, entry in enumerate(value[:PLOTTED]):
            yield from numbers_in(entry, f"{path}[{k}]")
    else:
        for name in fields_of(value):
            yield from numbers_in(getattr(value, name), f"{path}.{name}" if path else name)
