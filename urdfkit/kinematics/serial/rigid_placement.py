"""Placements as twelve floats, rotation by rows and translation, for modules that do without numpy."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import chain

from urdfkit.description.urdf.geometry import rotation_of, rotation_of_quaternion
from urdfkit.description.urdf.robot import Pose

Placement = Sequence[float]
"""Rotation (9, by rows) and translation (3)."""
IDENTITY: Placement = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)


def compose(a: Placement, b: Placement) -> Placement:
    """Return the placement `b` in the frame of `a`."""
    if a is IDENTITY:
        return b
    if b is IDENTITY:
        return a
    rotation = [sum(a[3 * i + k] * b[3 * k + j] for k in range(3)) for i in range(3) for j in range(3)]
    return [*rotation, *(a[9 + i] + sum(a[3 * i + k] * b[9 + k] for k in range(3)) for i in range(3))]


def invert(a: Placement) -> Placement:
    """Return the inverse of a placement."""
    rotation = [a[3 * j + i] for i in range(3) for j in range(3)]
    return [*rotation, *(-sum(rotation[3 * i + k] * a[9 + k] for k in range(3)) for i in range(3))]


def placement_of(pose: Pose) -> Placement:
    """Return an ``<origin>``: fixed-axis roll, pitch, yaw, i.e. Rz(yaw)·Ry(pitch)·Rx(roll)."""
    return [*chain.from_iterable(rotation_of(pose.rpy)), *pose.xyz]


def rotation_to(axis: Sequence[float]) -> Placement:
    """Return the smallest rotation that turns z to a unit vector; half a turn about x for -z."""
    x, y, z = axis
    if z < -1.0 + 1e-12:
        return (1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0)
    if x == y == 0.0:
        return IDENTITY
    scale = 1.0 / (1.0 + z)
    return (
        *(1.0 - x * x * scale, -x * y * scale, x),
        *(-x * y * scale, 1.0 - y * y * scale, y),
        *(-x, -y, 1.0 - (x * x + y * y) * scale),
        *(0.0, 0.0, 0.0),
    )


def turned(angle: float, slide: float) -> Placement:
    """Return a turn about z [rad] and a slide along it [m]."""
    sine, cosine = math.sin(angle), math.cos(angle)
    return (cosine, -sine, 0.0, sine, cosine, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, slide)


def placement_of_quaternion(xyz: Sequence[float], quaternion: Sequence[float]) -> Placement:
    """Return a translation [m] and the rotation of a quaternion x y z w that is not zero."""
    return [*chain.from_iterable(rotation_of_quaternion(*quaternion)), *xyz]
