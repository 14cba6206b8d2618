"""Poses and twists of messages as numbers, and poses in frames.

Poses are x y z [m] and a quaternion x y z w.
"""

from collections.abc import Sequence
from typing import Any

from urdfkit.sim.state.quaternion import product, rotate


def three(message: Any) -> tuple[float, float, float]:
    """Return x y z of a point or vector."""
    return float(message.x), float(message.y), float(message.z)


def six_of(twist: Any) -> tuple[float, ...]:
    """Return a twist, linear first."""
    return (*three(twist.linear), *three(twist.angular))


def seven_of(pose: Any) -> tuple[float, ...]:
    """Return a pose; a quaternion of zeros, the default of messages, is the identity."""
    q = pose.orientation
    turn = (float(q.x), float(q.y), float(q.z), float(q.w))
    return (*three(pose.position), *(turn if any(turn) else (0.0, 0.0, 0.0, 1.0)))


def composed(outer: Sequence[float], inner: Sequence[float]) -> tuple[float, ...]:
    """Return a pose that is given in the frame of another one."""
    x, y, z = rotate(outer[3:], inner[:3])
    return outer[0] + x, outer[1] + y, outer[2] + z, *product(outer[3:], inner[3:])


def point_in_frame(frame: Sequence[float], point: Sequence[float]) -> tuple[float, float, float]:
    """Return a point of the world in a frame."""
    x, y, z, w = frame[3:]
    return rotate((-x, -y, -z, w), [a - b for a, b in zip(point, frame[:3], strict=True)])
