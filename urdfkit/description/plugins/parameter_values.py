"""Values that a plugin accepts for its parameters: numbers, vectors, flags and choices.

The simulator leaves out a plugin with another value, and the linter reports the value.
"""

import re
from collections.abc import Iterator
from math import isfinite

from urdfkit.description.plugins.lookup import read_all, values
from urdfkit.description.plugins.spec import Parameter, PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.element import Element

TOPIC = re.compile(r"[A-Za-z0-9_./:~-]*")
"""Valid topic names. ROS allows fewer characters; gz sim makes topics of entity names with any of these."""

FLAGS = {"true": True, "1": True, "false": False, "0": False}
"""Flags in lower case."""

_POSITIVE = frozenset(
    (
        *("wheel_separation", "wheel_base", "wheel_radius", "wheel_diameter", "wheel_pairs", "kingpin_width"),
        *("actuated_diameter", "encoder_diameter", "max_speed", "max_steer", "max_steering_angle"),
    )
)
"""Meanings of numbers greater than zero."""

_UNSIGNED = frozenset(
    (
        *("max_wheel_torque", "max_wheel_acceleration", "max_wheel_deceleration", "wheel_tolerance"),
        *("steering_speed", "steering_tolerance", "gaussian_noise", "time", "field_of_view"),
        *("p_gain", "i_gain", "d_gain"),
    )
)
"""Meanings of numbers that are zero or greater."""

_VECTORS = {
    **dict.fromkeys(("xyz_offset", "rpy_offset", "initial_linear", "initial_angular"), 3),
    **dict.fromkeys(("left_steering_gains", "right_steering_gains", "speed_gains"), 3),
    **dict.fromkeys(("left_steering_range", "right_steering_range", "speed_range"), 2),
}
"""Meaning → count of its numbers."""

_CHOICES = {
    "odometry_source": (("encoder", "world", "0", "1"), "`encoder` or `world`, 0 or 1"),
    "dimensions": (("2", "3"), "2 or 3"),
}
"""Meaning → valid values, and their description."""


def expected(parameter: Parameter, text: str) -> str:
    """Return the description of valid values, such as ``a finite number``; empty if the value is valid.

    Args:
        parameter: the parameter.
        text: the value as written.
    """
    meaning = parameter.meaning
    if meaning in _CHOICES:
        values, description = _CHOICES[meaning]
        return "" if text.strip() in values else description
    if meaning in _VECTORS:
        return "" if vector(text, _VECTORS[meaning]) is not None else f"{_VECTORS[meaning]} finite numbers"
    if (parameter.default or "") in ("true", "false"):
        return "" if text.lower() in FLAGS else "true or false"
    return expected_number(meaning, text) if is_number(parameter) else ""


def expected_number(meaning: str, text: str, *, unsigned: bool = False) -> str:
    """Return the description of valid numbers; empty if the number is valid.

    Args:
        meaning: meaning of the parameter.
        text: the value as written.
        unsigned: whether negative numbers are invalid, too.
    """
    value = number(text)
    if meaning in _POSITIVE:
        return "" if value is not None and value > 0.0 else "a number greater than zero"
    if unsigned or meaning in _UNSIGNED:
        return "" if value is not None and value >= 0.0 else "a number, zero or greater"
    return "" if value is not None else "a finite number"


def is_number(parameter: Parameter) -> bool:
    """Return whether the value of a parameter is one number: it has a unit, or its default is a number."""
    return parameter.names is None and (bool(parameter.unit) or number(parameter.default or "") is not None)


def number(text: str) -> float | None:
    """Return a text as a finite number; None for other texts."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) else None


def vector(text: str, length: int) -> tuple[float, ...] | None:
    """Return a text as finite numbers separated by blanks, zeros for an empty text; None for other texts."""
    found = tuple(number(word) for word in text.split()) or (0.0,) * length
    return None if len(found) != length or None in found else found  # type: ignore[return-value]


def invalid_values(plugin: Plugin, spec: PluginSpec) -> Iterator[tuple[Element, str]]:
    """Yield the elements of a plugin with invalid values, and the defect of each; see `expected`."""
    for parameter in spec.parameters:
        for text, element in values(plugin, parameter):
            if text and "$" not in text and (wanted := expected(parameter, text)):
                yield element, f"<{parameter.tag}> is `{text}`; it must be {wanted}"
    least, most = (_command(plugin, spec, meaning) for meaning in ("min_command", "max_command"))
    if least is not None and most is not None and least[0] > most[0] and (place := most[1] or least[1]) is not None:
        yield place, f"the minimum command {least[0]:g} is greater than the maximum {most[0]:g}"


def unpaired_wheels(plugin: Plugin, spec: PluginSpec) -> tuple[Element, str] | None:
    """Return the defect of a differential drive without as many left as right wheels, and its element."""
    texts = read_all(plugin, spec)
    left, right = len(texts["left_joint"]), len(texts["right_joint"])
    pairs = spec.by_meaning("wheel_pairs")
    wanted = number(texts["wheel_pairs"][0]) if pairs is not None else float(left)
    if wanted is None or (left and right and left == right == int(wanted)):
        return None
    needed = f"{int(wanted)} of each" if pairs is not None else "equal numbers of both, at least one of each"
    tags = [parameter.tag for name in ("left_joint", "right_joint") if (parameter := spec.by_meaning(name)) is not None]
    place = pairs or spec.by_meaning("left_joint")
    written = (element for text, element in values(plugin, place) if text) if place is not None else iter(())
    message = f"{left} <{tags[0]}> and {right} <{tags[1]}>; this drive needs {needed}"
    return next(written, plugin.element), message


def _command(plugin: Plugin, spec: PluginSpec, meaning: str) -> tuple[float, Element | None] | None:
    """Return a limit of the command and its element; None if the plugin has no such limit or its value is invalid."""
    parameter = spec.by_meaning(meaning)
    if parameter is None:
        return None
    text, element = next((pair for pair in values(plugin, parameter) if pair[0]), (parameter.default or "", None))
    value = number(text)
    return None if value is None else (value, element)
