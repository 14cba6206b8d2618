"""Poses without numpy: composed, inverted, and read back as fixed-axis roll, pitch, yaw."""

from __future__ import annotations

from math import asin, atan2, copysign, cos, hypot, pi, sin

from urdfkit.description.urdf.robot import Pose, Vector

Rotation = tuple[Vector, Vector, Vector]
"""A rotation matrix by rows."""

IDENTITY = Pose()


def rotation_of(pose: Pose) -> Rotation:
    """Return Rz(yaw)·Ry(pitch)·Rx(roll)."""
    roll, pitch, yaw = pose.rpy
    cr, sr, cp, sp, cy, sy = cos(roll), sin(roll), cos(pitch), sin(pitch), cos(yaw), sin(yaw)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def rotate(rotation: Rotation, vector: Vector) -> Vector:
    """Return rotation · vector."""
    x, y, z = vector
    a, b, c = rotation
    return (
        a[0] * x + a[1] * y + a[2] * z,
        b[0] * x + b[1] * y + b[2] * z,
        c[0] * x + c[1] * y + c[2] * z,
    )


def transpose(rotation: Rotation) -> Rotation:
    """Return the inverse of a rotation."""
    a, b, c = rotation
    return (a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])


def rpy_of(rotation: Rotation) -> Vector:
    """Return fixed-axis roll, pitch, yaw [rad]; in gimbal lock the whole rotation is yaw."""
    a, b, c = rotation
    flat = hypot(a[0], b[0])
    if flat < 1e-9:
        return 0.0, copysign(pi / 2, -c[0]), atan2(-a[1], b[1])
    pitch = asin(max(-1.0, min(1.0, -c[0]))) if abs(c[0]) < 0.9 else atan2(-c[0], flat)
    return atan2(c[1], c[2]), pitch, atan2(b[0], a[0])


def rpy_of_quaternion(x: float, y: float, z: float, w: float) -> Vector:
    """Return roll, pitch, yaw [rad] of a quaternion that need not be normalised, but is not zero."""
    s = 2.0 / (x * x + y * y + z * z + w * w)
    return rpy_of(
        (
            (1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)),
            (s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)),
            (s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)),
        )
    )


def compose(outer: Pose, inner: Pose) -> Pose:
    """Return outer · inner: `inner` is given in a frame with the pose `outer`. Exact where either is the identity."""
    if outer == IDENTITY:
        return inner
    if inner == IDENTITY:
        return outer
    turn = rotation_of(outer)
    x, y, z = rotate(turn, inner.xyz)
    xyz = (outer.xyz[0] + x, outer.xyz[1] + y, outer.xyz[2] + z)
    if inner.rpy == IDENTITY.rpy:
        return Pose(xyz, outer.rpy)
    if outer.rpy == IDENTITY.rpy:
        return Pose(xyz, inner.rpy)
    columns = [rotate(turn, column) for column in transpose(rotation_of(inner))]
    return Pose(xyz, rpy_of(transpose((columns[0], columns[1], columns[2]))))


def inverse(pose: Pose) -> Pose:
    """Return the pose that composed with `pose` is the identity."""
    back = transpose(rotation_of(pose))
    x, y, z = rotate(back, pose.xyz)
    return Pose((-x, -y, -z), pose.rpy if pose.rpy == IDENTITY.rpy else rpy_of(back))


def between(start: Pose, end: Pose) -> Pose:
    """Return `end` as seen from `start`, both given in one frame."""
    return compose(inverse(start), end)


def difference(a: Pose, b: Pose) -> float:
    """Return the difference of two poses: the larger of the distance [m] and of the entries of their rotations."""
    distance = max(abs(x - y) for x, y in zip(a.xyz, b.xyz, strict=True))
    rows = zip(rotation_of(a), rotation_of(b), strict=True)
    return max(distance, *(abs(x - y) for row, other in rows for x, y in zip(row, other, strict=True)))
