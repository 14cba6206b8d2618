"""Messages from the values of their fields, as users write them in YAML or JSON.

numpy is imported on first use, not with this module.
"""

from functools import cache
from typing import Any

from urdfkit.messages.types import full_type_name, message_type, type_layouts


def from_fields(type: str, fields: Any) -> Any:
    """Return a message with these fields, the others zero or empty, as ``rostopic pub`` fills them in.

    Args:
        type: its type.
        fields: field → value, nested like the message; None for no fields. A message may also be the list of its
            fields, a time or duration a number of seconds; ROS 1's ``secs``, ``nsecs`` and ``seq`` are accepted too.

    Raises:
        UsageError: no such type or field, or a value of the wrong kind.

    Examples:
        >>> from urdfkit.messages import from_fields
        >>> from_fields("geometry_msgs/msg/Twist", {"linear": {"x": 0.5}}).linear.x
        0.5
    """
    from urdfkit.errors import UsageError, did_you_mean

    full = full_type_name(type)
    kind = message_type(full)
    layout = dict(type_layouts()[full][1])
    if full in _MOMENTS:
        fields = _moment(full, fields)
    elif full == "std_msgs/msg/Header" and isinstance(fields, dict):
        fields = {name: value for name, value in fields.items() if name != "seq"}
    if isinstance(fields, list) and len(fields) == len(layout):
        fields = dict(zip(layout, fields, strict=True))
    if fields is not None and not isinstance(fields, dict):
        raise UsageError(f"`{fields}` is not a {full}: write its fields, {', '.join(layout)}")
    for name in fields or {}:
        if name not in layout:
            raise UsageError(
                f"no field `{name}` in {full}{did_you_mean(str(name), layout)} (it has {', '.join(layout)})"
            )
    supplied = fields or {}
    return kind(**{name: _value(full, name, description, supplied.get(name)) for name, description in layout.items()})


def as_message(type: str, value: Any) -> Any:
    """Return a message as it is, or the message with these fields.

    Args:
        type: its type.
        value: a message, also one of rclpy or rospy, or fields; see `from_fields`.

    Raises:
        UsageError: no such type or field, or a value of the wrong kind.
    """
    marks = ("__msgtype__", "get_fields_and_field_types", "_type")  # of rosbags, rclpy and rospy
    return value if any(hasattr(value, mark) for mark in marks) else from_fields(type, value)


_MOMENTS = ("builtin_interfaces/msg/Time", "builtin_interfaces/msg/Duration")


def _moment(type: str, fields: Any) -> Any:
    """Return the fields of a time or duration that may be seconds, or be written as in ROS 1.

    Raises:
        UsageError: a field is set twice, is not a number, or is out of range.
    """
    import math

    from urdfkit.errors import UsageError

    named = {"secs": "sec", "nsecs": "nanosec"}
    if isinstance(fields, dict):
        if len({named.get(name, name) for name in fields}) < len(fields):
            raise UsageError(f"`{fields}` sets the same field twice: {type} has sec and nanosec")
        fields = {named.get(name, name): value for name, value in fields.items()}
        if not isinstance(fields.get("sec"), float):
            return fields
    seconds = fields.get("sec") if isinstance(fields, dict) else fields
    if isinstance(seconds, bool) or not isinstance(seconds, int | float):
        return fields
    if not (-(2**31) if type.endswith("Duration") else 0) <= seconds < 2**31:
        raise UsageError(f"`{seconds}` is out of range for {type}: seconds, at most {2**31 - 1}")
    whole = math.floor(seconds)
    rest = round((seconds - whole) * 1e9)
    more = fields if isinstance(fields, dict) else {}
    if rest and "nanosec" in more:
        raise UsageError(f"`{fields}` sets the fraction of a second twice: {type} has sec, an integer, and nanosec")
    return {**more, "sec": whole + rest // 10**9, **({"nanosec": rest % 10**9} if rest else {})}


@cache
def _range(base: str) -> tuple[float, float]:
    """Return the least and the greatest number of a base type."""
    import numpy as np

    if "int" not in base:
        return -np.inf, np.inf
    return int(np.iinfo(base).min), int(np.iinfo(base).max)


def _value(type: str, name: str, description: Any, value: Any) -> Any:
    """Return the value of one field, by rosbags' description of it: (node type, details).

    Raises:
        UsageError: a value of the wrong kind.
    """
    import numpy as np

    from urdfkit.errors import UsageError

    node, details = int(description[0]), description[1]
    if node == 2:
        return from_fields(details, value)
    if node == 1:
        base = details[0]
        try:
            if base == "string":
                text = "" if value is None else str(value)
                text.encode()  # raises for half of a pair of surrogates, which JSON can express
                return text
            value = 0 if value is None else value
            if base == "bool":
                return bool((False, True).index(value))  # raises for other values, such as the text "false"
            is_whole = not base.startswith("float")
            number = int(value) if is_whole else float(value)
            if is_whole and isinstance(value, float) and number != value:
                raise ValueError("an integer has no fraction")
            least, most = _range(base)
            if number < least or number > most:
                raise UsageError(f"field `{name}` of {type} is {value}; it must be {base}, {least} to {most}")
            return number
        except UnicodeEncodeError:
            raise UsageError(f"field `{name}` of {type} is {value!a}, which is not Unicode") from None
        except (TypeError, ValueError, OverflowError):
            raise UsageError(f"field `{name}` of {type} is `{value}`; it must be {base}") from None
    inner, length = details
    if isinstance(value, np.ndarray) and int(inner[0]) == 1 and str(value.dtype) == inner[1][0]:
        if node == 4 or len(value) == length:
            return value  # without a copy
        value = value.tolist()
    items = [None] * length if value is None else value
    if not isinstance(items, list) or (node == 3 and len(items) != length):
        raise UsageError(
            f"field `{name}` of {type} is `{value}`; it must be a list{f' of {length}' if node == 3 else ''}"
        )
    made = [_value(type, name, inner, item) for item in items]
    base = inner[1][0] if int(inner[0]) == 1 else "string"
    return made if base == "string" else np.array(made, dtype=base)
