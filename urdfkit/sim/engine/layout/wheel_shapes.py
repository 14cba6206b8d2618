"""Which collision shapes are wheels: round about the axis of the joint that carries them."""

from dataclasses import replace

import numpy as np

from urdfkit.kinematics.model import Kinematics
from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.sim.engine.collision.support_points import HULL
from urdfkit.sim.engine.contact_surface import Touching
from urdfkit.sim.engine.contacts import ground_contacts
from urdfkit.sim.engine.layout.tree_arrays import joint_subspace

SIDES = 12
"""Fewest corners of a rim that is taken for a circle."""
TREAD = 0.97
"""Part of a mesh's radius from which on it belongs to the rim."""
ALIGNED = 1e-3
"""Furthest that an axis may lie off the joint's [rad, m]."""


def as_wheel(touch: Touching, kinematics: Kinematics, joint: int) -> Touching:
    """Return a shape as a wheel where it is one, else as it is.

    A wheel touches the ground in the middle of its rim. It is a cylinder about the axis of the revolute joint that
    carries it, or a mesh whose rim, seen along that axis, has at least `SIDES` corners all the way round: it rolls as
    the circle through them, which a polygon would not.
    """
    subspace = joint_subspace(kinematics.model, joint)
    if subspace.shape[1] != 1 or not subspace[3:, 0].any():
        return touch
    axis = subspace[3:, 0]
    if touch.kind == ground_contacts.CYLINDER:
        along = np.cross(axis, touch.R[:, 2])
        off = touch.p - axis * matmul(axis, touch.p)
        aligned = vector_norm(along) < ALIGNED and vector_norm(off) < ALIGNED
        return replace(touch, kind=ground_contacts.WHEEL) if aligned else touch
    return _round(touch, axis) if touch.kind == HULL else touch


def _round(touch: Touching, axis: Array) -> Touching:
    """Return a hull that is round about an axis through the joint as a wheel, any other as it is."""
    points = matmul(touch.vertices, touch.R.T) + touch.p
    height = matmul(points, axis)
    out = points - height[:, None] * axis
    distance = np.linalg.norm(out, axis=1)
    radius = float(distance.max())
    if radius == 0.0:
        return touch
    rim = distance > TREAD * radius
    first = out[int(distance.argmax())] / radius
    angles = np.sort(np.arctan2(matmul(out[rim], np.cross(axis, first)), matmul(out[rim], first)))
    gaps = np.diff(np.append(angles, angles[0] + 2.0 * np.pi))
    if gaps.max() > 2.0 * np.pi / SIDES * 1.01:
        return touch
    low, high = float(height[rim].min()), float(height[rim].max())
    half = 0.5 * (high - low)
    return replace(
        touch,
        kind=ground_contacts.WHEEL,
        size=(radius, half, 0.0),
        R=np.column_stack([first, np.cross(axis, first), axis]),
        p=0.5 * (low + high) * axis,
        radius=float(np.hypot(radius, half)),
        vertices=np.zeros((0, 3)),
    )
