"""Numbers, pose and rate of a ``<sensor>``; errors contain the position of the invalid value."""

from collections.abc import Iterable, Sequence
from math import isfinite, isnan

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.robot import Pose
from urdfkit.description.xml.element import Element
from urdfkit.errors import SimulationError, did_you_mean
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.sim.plugins.parameters import Parameters


def number(
    parent: Element | None, tag: str, default: float, *, infinite: bool = False, least: float | None = None
) -> float:
    """Return the number in a child element; the default if the element is missing or empty.

    Args:
        parent: parent element; None if it is missing.
        tag: tag of the child.
        default: default value.
        infinite: whether infinity is allowed.
        least: smallest value allowed.

    Raises:
        SimulationError: the value is not such a number, with its position.
    """
    child = None if parent is None else parent.find(tag)
    if child is None or not child.text.strip():
        return default
    try:
        value = float(child.text)
    except ValueError:
        value = float("nan")
    if isnan(value) or not (infinite or isfinite(value)) or (least is not None and value < least):
        wanted = "a number" if infinite else "a finite number"
        wanted += "" if least is None else f", {least:g} or greater"
        raise SimulationError(
            f"<{tag}> is `{child.text}`; it must be {wanted}", position=child.origin.position, code="Z823"
        )
    return value


def choice(parent: Element | None, tag: str, allowed: Sequence[str], default: str, *, in_any_case: bool = False) -> str:
    """Return the word in a child element; the default if the element is missing or empty.

    Args:
        parent: parent element; None if it is missing.
        tag: tag of the child.
        allowed: the words.
        default: default word.
        in_any_case: whether the word may have capital letters.

    Raises:
        SimulationError: the word is not allowed, with its position.
    """
    child = None if parent is None else parent.find(tag)
    if child is None or not child.text:
        return default
    text = child.text.lower() if in_any_case else child.text
    if text not in allowed:
        message = f"<{tag}> is `{text}`; it must be {', '.join(allowed)}{did_you_mean(text, allowed)}"
        raise SimulationError(message, position=child.origin.position)
    return text


def refuse(found: Iterable[tuple[Element, str]]) -> None:
    """Raise an error for the first invalid element, if any.

    Raises:
        SimulationError: the list contains an invalid element, with its position.
    """
    for element, message in found:
        raise SimulationError(message, position=element.origin.position, code="Z823")


def pose_of(sensor: Element) -> NDArray[np.float64]:
    """Return the ``<pose>`` of a sensor in its link; shape (4, 4).

    Raises:
        SimulationError: it is not six finite numbers, with its position.
    """
    child = sensor.find("pose") or sensor.find("origin")
    if child is None:
        return np.eye(4)
    text = child.text or f"{child.get('xyz') or '0 0 0'} {child.get('rpy') or '0 0 0'}"
    try:
        x, y, z, roll, pitch, yaw = (float(word) for word in text.split())
    except ValueError:
        x = y = z = roll = pitch = yaw = float("nan")
    if not all(isfinite(each) for each in (x, y, z, roll, pitch, yaw)):
        raise SimulationError(f"<pose> is `{text}`; it must be 6 finite numbers", position=child.origin.position)
    return pose_matrix(Pose((x, y, z), (roll, pitch, yaw)))


def rate_of(sensor: Element | None, read: Parameters) -> float:
    """Return the rate of a sensor [Hz]: the lower of its ``<update_rate>`` and its plugin's; unset rates are ignored.

    Zero means every step, as in Gazebo.

    Raises:
        SimulationError: a rate is negative or no number, with its position.
    """
    rates = number(sensor, "update_rate", 0.0, least=0.0), read.number("update_rate", unsigned=True)
    return min((rate for rate in rates if rate > 0), default=0.0)


def rotation_matrix(roll: float, pitch: float, yaw: float) -> NDArray[np.float64]:
    """Return the rotation by fixed-axis roll, pitch and yaw [rad]; shape (3, 3)."""
    found: NDArray[np.float64] = pose_matrix(Pose((0.0, 0.0, 0.0), (roll, pitch, yaw)))[:3, :3]
    return found
