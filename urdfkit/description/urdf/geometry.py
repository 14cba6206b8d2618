"""Geometry without numpy: rotations, poses, and the bounding boxes, volumes and second moments of primitives."""

from collections.abc import Sequence
from math import asin, atan2, copysign, cos, hypot, pi, sin, sqrt

from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Pose, Robot, Sphere, Vector

Rotation = tuple[Vector, Vector, Vector]
"""A rotation matrix by rows."""
Bounds = tuple[Vector, Vector]
"""Minimum and maximum corner of an axis-aligned box [m]."""

IDENTITY = Pose()
UNROTATED: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""The identity matrix."""


def rotation_of(rpy: Vector) -> Rotation:
    """Return Rz(yaw)·Ry(pitch)·Rx(roll) of fixed-axis angles [rad]."""
    if rpy == (0.0, 0.0, 0.0):
        return UNROTATED
    (sr, sp, sy), (cr, cp, cy) = map(sin, rpy), map(cos, rpy)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def rotation_of_quaternion(x: float, y: float, z: float, w: float) -> Rotation:
    """Return the rotation of a non-zero quaternion, normalised or not."""
    s = 2.0 / (x * x + y * y + z * z + w * w)
    return (
        (1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)),
        (s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)),
        (s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)),
    )


def rotate(rotation: Rotation, vector: Vector) -> Vector:
    """Return rotation · vector."""
    x, y, z = vector
    a, b, c = rotation
    return (a[0] * x + a[1] * y + a[2] * z, b[0] * x + b[1] * y + b[2] * z, c[0] * x + c[1] * y + c[2] * z)


def transpose(rotation: Rotation) -> Rotation:
    """Return the inverse of a rotation."""
    a, b, c = rotation
    return (a[0], b[0], c[0]), (a[1], b[1], c[1]), (a[2], b[2], c[2])


def product(first: Rotation, second: Rotation) -> Rotation:
    """Return first · second."""
    if first is UNROTATED or second is UNROTATED:
        return second if first is UNROTATED else first
    a, b, c = (rotate(first, column) for column in transpose(second))
    return transpose((a, b, c))


def unit(vector: Vector) -> Vector | None:
    """Return the vector normalised to length 1; None for the zero vector."""
    length = sqrt(sum(value * value for value in vector))
    return (vector[0] / length, vector[1] / length, vector[2] / length) if length > 1e-12 else None


def rpy_of(rotation: Rotation) -> Vector:
    """Return fixed-axis roll, pitch, yaw [rad]; in gimbal lock roll is zero."""
    a, b, c = rotation
    flat = hypot(a[0], b[0])
    if flat < 1e-12:
        return 0.0, copysign(pi / 2, -c[0]), atan2(-a[1], b[1])
    pitch = asin(max(-1.0, min(1.0, -c[0]))) if abs(c[0]) < 0.9 else atan2(-c[0], flat)
    yaw = atan2(b[0], a[0])
    if flat > 1e-3:
        return atan2(c[1], c[2]), pitch, yaw
    # Near gimbal lock, rounding of the yaw is large: the roll that belongs to this yaw makes up for it.
    sy, cy = sin(yaw), cos(yaw)
    return atan2(a[2] * sy - b[2] * cy, b[1] * cy - a[1] * sy), pitch, yaw


def rpy_of_quaternion(x: float, y: float, z: float, w: float) -> Vector:
    """Return roll, pitch, yaw [rad] of a non-zero quaternion, normalised or not."""
    return rpy_of(rotation_of_quaternion(x, y, z, w))


def compose(outer: Pose, inner: Pose) -> Pose:
    """Return outer · inner, where `inner` is relative to the frame `outer`; exact if either is the identity."""
    if outer == IDENTITY:
        return inner
    if inner == IDENTITY:
        return outer
    turn = rotation_of(outer.rpy)
    x, y, z = rotate(turn, inner.xyz)
    xyz = (outer.xyz[0] + x, outer.xyz[1] + y, outer.xyz[2] + z)
    if inner.rpy == IDENTITY.rpy:
        return Pose(xyz, outer.rpy)
    if outer.rpy == IDENTITY.rpy:
        return Pose(xyz, inner.rpy)
    return Pose(xyz, rpy_of(product(turn, rotation_of(inner.rpy))))


def inverse(pose: Pose) -> Pose:
    """Return the inverse transform of a pose."""
    back = transpose(rotation_of(pose.rpy))
    x, y, z = rotate(back, pose.xyz)
    return Pose((-x, -y, -z), pose.rpy if pose.rpy == IDENTITY.rpy else rpy_of(back))


def between(start: Pose, end: Pose) -> Pose:
    """Return `end` relative to `start`; both are relative to the same frame."""
    return compose(inverse(start), end)


def difference(a: Pose, b: Pose) -> float:
    """Return the difference of two poses: the larger of the distance [m] and of the entries of their rotations."""
    distance = max(abs(x - y) for x, y in zip(a.xyz, b.xyz, strict=True))
    rows = zip(rotation_of(a.rpy), rotation_of(b.rpy), strict=True)
    return max(distance, *(abs(x - y) for row, other in rows for x, y in zip(row, other, strict=True)))


def link_poses(robot: Robot, base: str | None = None) -> dict[str, Pose]:
    """Return link name → its pose in the root link, or in the link `base` above it, every joint at zero."""
    found = {base: Pose()} if base is not None else {root.name: Pose() for root in robot.roots()}
    for joint in tree_order(robot):
        if joint.child is not None and joint.parent in found and joint.child not in found:
            found[joint.child] = compose(found[joint.parent], joint.origin)
    return found


def volume_of(shape: Geometry) -> float:
    """Return the volume of a shape [m³]; 0 for a mesh."""
    if isinstance(shape, Box):
        return abs(shape.size[0] * shape.size[1] * shape.size[2])
    if isinstance(shape, Sphere):
        return 4.0 / 3.0 * pi * shape.radius**3
    if isinstance(shape, Cylinder):
        return pi * shape.radius**2 * shape.length
    if isinstance(shape, Capsule):
        return pi * shape.radius**2 * (shape.length + 4.0 / 3.0 * shape.radius)
    return 0.0


def box_around(shape: Geometry, pose: Pose) -> Bounds:
    """Return the axis-aligned bounding box of a shape at a pose; a mesh counts as a point."""
    half: list[float] = []
    for row in rotation_of(pose.rpy):
        if isinstance(shape, Box):
            half.append(sum(abs(a * size) / 2.0 for a, size in zip(row, shape.size, strict=True)))
        elif isinstance(shape, Cylinder):
            half.append(abs(row[2]) * shape.length / 2.0 + shape.radius * sqrt(max(0.0, 1.0 - row[2] ** 2)))
        elif isinstance(shape, Capsule):
            half.append(abs(row[2]) * shape.length / 2.0 + shape.radius)
        else:
            half.append(shape.radius if isinstance(shape, Sphere) else 0.0)
    x, y, z = pose.xyz
    return (x - half[0], y - half[1], z - half[2]), (x + half[0], y + half[1], z + half[2])


def box_around_all(boxes: Sequence[Bounds]) -> Bounds:
    """Return the bounding box of one or more boxes."""
    a, b, c = (min(low[axis] for low, _ in boxes) for axis in range(3))
    d, e, f = (max(high[axis] for _, high in boxes) for axis in range(3))
    return (a, b, c), (d, e, f)


def second_moments(shape: Geometry) -> Vector:
    """Return the mean of x², y² and z² over a solid about its centre [m²]."""
    if isinstance(shape, Box):
        x, y, z = (size * size / 12.0 for size in shape.size)
        return x, y, z
    if isinstance(shape, Sphere):
        square = shape.radius**2 / 5.0
        return square, square, square
    if isinstance(shape, Cylinder):
        return shape.radius**2 / 4.0, shape.radius**2 / 4.0, shape.length**2 / 12.0
    if isinstance(shape, Capsule):
        r, h = shape.radius, shape.length
        middle, ends = h, 4.0 / 3.0 * r  # volumes divided by πr²
        across = (middle * r**2 / 4.0 + ends * r**2 / 5.0) / (middle + ends)
        along = (middle * h**2 / 12.0 + ends * (h**2 / 4.0 + 3.0 / 8.0 * h * r + r**2 / 5.0)) / (middle + ends)
        return across, across, along
    return 0.0, 0.0, 0.0


def principal_moments(shape: Geometry, mass: float) -> Vector:
    """Return the principal moments of inertia of a solid with a mass [kg] about its centre [kg·m²]."""
    x, y, z = second_moments(shape)
    return mass * (y + z), mass * (x + z), mass * (x + y)


def combined(parts: Sequence[tuple[Pose, float, Vector]]) -> tuple[float, Vector, list[list[float]]]:
    """Return mass [kg], centre of mass [m] and the inertia tensor about it [kg·m²] of several solids.

    Args:
        parts: pose, mass and principal moments of each solid; the total mass must not be 0.
    """
    mass, axes = sum(part[1] for part in parts), range(3)
    x, y, z = centre = tuple([sum(pose.xyz[axis] * own for pose, own, _ in parts) / mass for axis in axes])
    tensor = [[0.0] * 3 for _ in axes]
    for pose, own, moments in parts:
        turn = rotation_of(pose.rpy)
        offset = [pose.xyz[axis] - centre[axis] for axis in axes]
        square = sum(each * each for each in offset)
        for row in axes:
            for column in axes:
                turned = sum(turn[row][k] * moments[k] * turn[column][k] for k in axes)
                offset_term = (square if row == column else 0.0) - offset[row] * offset[column]
                tensor[row][column] += turned + own * offset_term
    return mass, (x, y, z), tensor


def rotated_tensor(tensor: Sequence[Sequence[float]], frame: Rotation) -> tuple[float, ...]:
    """Return xx, xy, xz, yy, yz, zz of a symmetric tensor along the axes of a frame."""
    axes = range(3)
    return tuple(
        sum(frame[k][i] * tensor[k][n] * frame[n][j] for k in axes for n in axes) for i in axes for j in range(i, 3)
    )
