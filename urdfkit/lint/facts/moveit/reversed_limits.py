"""Limits of joints that exclude all states of the SRDF, although limits with opposite signs would include them."""

from collections.abc import Iterator

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number

_FEWEST = 2
"""Smallest number of states that the limits exclude."""

_TOLERANCE = 1e-3


def reversed_limits(root: Element, robot: Robot) -> Iterator[tuple[list[Joint], list[float]]]:
    """Yield the joints with one ``<limit>`` in the source that excludes all their states, and the values there.

    Args:
        root: root element of the SRDF.
        robot: the robot.
    """
    found: dict[object, list[tuple[Joint, float]]] = {}
    for state in root.find_all("group_state"):
        for value in state.find_all("joint"):
            joint = robot.joint_by_name.get(value.get("name") or "")
            position = number(value.get("value") or "")
            if joint is not None and joint.limit is not None and position is not None and abs(position) > _TOLERANCE:
                found.setdefault(joint.limit.element.origin.position, []).append((joint, position))
    for uses in found.values():
        if len(uses) >= _FEWEST and all(_is_excluded(joint, position) for joint, position in uses):
            yield list(dict.fromkeys(joint for joint, _ in uses)), [position for _, position in uses]


def _is_excluded(joint: Joint, value: float) -> bool:
    """Return whether a position is beyond the limits of a joint, but within the limits with opposite signs."""
    lower, upper = (joint.limit.lower, joint.limit.upper) if joint.limit is not None else (None, None)
    if joint.type not in ("revolute", "prismatic") or lower is None or upper is None or lower >= upper:
        return False
    low, high = lower - _TOLERANCE, upper + _TOLERANCE
    return not low <= value <= high and low <= -value <= high
