"""Union of the shapes of a link: volume, centroid and second moments, without numpy.

Moments of primitives are closed forms, moments of closed meshes are sums over their triangles. Where primitives
overlap, the overlap counts once: it is integrated over quasirandom points in each of the shapes, each point weighted by
the number of shapes that contain it. Only overlaps are sampled, so the result is exact for separate shapes.
"""

from collections.abc import Iterator, Sequence
from math import cos, hypot, pi, sin, sqrt

from urdfkit.description.urdf.geometry import (
    UNROTATED,
    Rotation,
    box_around,
    rotated_tensor,
    rotation_of,
    second_moments,
    volume_of,
)
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Mesh, Pose, Sphere, Vector
from urdfkit.record import record

POINTS = 20_000
"""Sample points in each overlapping shape; the relative error of the overlap is about 1e-3."""
FEWEST_POINTS = 100
"""Sample points in each of very many overlapping shapes."""
MAX_CHECKS = 1_000_000
"""Checks whether a shape contains a point, about 1 s; beyond it each shape has fewer points."""

_STEPS = (0.8191725134, 0.6710436067, 0.5497004779)
"""Steps of the quasirandom sequence (Roberts, The unreasonable effectiveness of quasirandom sequences, 2018)."""


@record
class Moments:
    """Moments of a volume at density 1, about the origin of its frame.

    Attributes:
        volume: [m³].
        first: integrals of x, y and z [m⁴].
        second: integrals of x², xy, xz, y², yz and z² [m⁵].
    """

    volume: float
    first: Vector
    second: tuple[float, ...]

    @property
    def middle(self) -> Vector:
        """The centroid of the volume [m]."""
        x, y, z = (value / self.volume for value in self.first)
        return x, y, z

    def tensor(self, mass: float, frame: Rotation = UNROTATED) -> tuple[float, ...]:
        """Return ixx, ixy, ixz, iyy, iyz, izz [kg·m²] about the centroid for a mass [kg], along the axes of a frame."""
        density, (x, y, z) = mass / self.volume, self.middle
        xx, xy, xz, yy, yz, zz = (
            density * value - mass * shift
            for value, shift in zip(self.second, (x * x, x * y, x * z, y * y, y * z, z * z), strict=True)
        )
        xy, xz, yz = 0.0 - xy, 0.0 - xz, 0.0 - yz  # not -0
        rows = [[yy + zz, xy, xz], [xy, xx + zz, yz], [xz, yz, xx + yy]]
        return rotated_tensor(rows, frame)


def total(parts: Sequence[Moments]) -> Moments:
    """Return the sum of several moments in the same frame."""
    x, y, z = (sum(part.first[i] for part in parts) for i in range(3))
    second = tuple(sum(part.second[i] for part in parts) for i in range(6))
    return Moments(sum(part.volume for part in parts), (x, y, z), second)


def placed(moments: Moments, pose: Pose) -> Moments:
    """Return the moments in the parent frame of `pose`."""
    rows, volume = rotation_of(pose.rpy), moments.volume
    own = moments.second
    square = ((own[0], own[1], own[2]), (own[1], own[3], own[4]), (own[2], own[4], own[5]))
    shift, turned = pose.xyz, [sum(row[k] * moments.first[k] for k in range(3)) for row in rows]
    first = [volume * a + b for a, b in zip(shift, turned, strict=True)]
    second = []
    for i, j in ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)):
        inside = sum(rows[i][k] * square[k][n] * rows[j][n] for k in range(3) for n in range(3))
        second.append(inside + shift[i] * turned[j] + turned[i] * shift[j] + volume * shift[i] * shift[j])
    return Moments(volume, (first[0], first[1], first[2]), tuple(second))


def of_primitive(shape: Geometry) -> Moments:
    """Return the moments of a box, cylinder, sphere or capsule about its centre."""
    volume = volume_of(shape)
    x, y, z = second_moments(shape)
    return Moments(volume, (0.0, 0.0, 0.0), (volume * x, 0.0, 0.0, volume * y, 0.0, volume * z))


def union(shapes: Sequence[tuple[Geometry, Pose, Moments]]) -> tuple[Moments, float, bool]:
    """Return the moments of the union of shapes, the volume of overlaps [m³], and whether a mesh may overlap others.

    Args:
        shapes: each with its pose and its moments in its own frame. Overlaps with meshes count twice.
    """
    shapes = list(dict.fromkeys(shapes))
    boxes = [box_around(shape, pose) if not isinstance(shape, Mesh) else None for shape, pose, _ in shapes]
    parts = [placed(moments, pose) for _, pose, moments in shapes]
    near = [
        [
            (other, where)
            for n, (other, where, _) in enumerate(shapes)
            if n != index and box is not None and (around := boxes[n]) is not None and _meet(box, around)
        ]
        for index, box in enumerate(boxes)
    ]
    points = max(FEWEST_POINTS, min(POINTS, MAX_CHECKS // max(1, sum(map(len, near)))))
    shared = [
        _shared(shape, pose, others, moments.volume, points)
        for (shape, pose, moments), others in zip(shapes, near, strict=True)
        if others
    ]
    whole = total(parts)
    if shared:
        less = total(shared)
        x, y, z = (a - b for a, b in zip(whole.first, less.first, strict=True))
        second = tuple(a - b for a, b in zip(whole.second, less.second, strict=True))
        whole = Moments(whole.volume - less.volume, (x, y, z), second)
    meshes = sum(isinstance(shape, Mesh) for shape, *_ in shapes)
    return whole, sum(part.volume for part in shared), meshes > 0 and len(shapes) > 1


def _meet(first: tuple[Vector, Vector], second: tuple[Vector, Vector]) -> bool:
    return all(first[0][i] < second[1][i] and second[0][i] < first[1][i] for i in range(3))


def _shared(shape: Geometry, pose: Pose, near: list[tuple[Geometry, Pose]], volume: float, points: int) -> Moments:
    """Return the overlaps of a shape with others, weighted by 1 − 1/(number of shapes that contain the point)."""
    rows, (a, b, c) = rotation_of(pose.rpy), pose.xyz
    others = [(other, where.xyz, tuple(zip(*rotation_of(where.rpy), strict=True))) for other, where in near]
    sums = [0.0] * 10
    count = 0
    for u, v, w in _spread(shape, points):
        count += 1
        x = a + rows[0][0] * u + rows[0][1] * v + rows[0][2] * w
        y = b + rows[1][0] * u + rows[1][1] * v + rows[1][2] * w
        z = c + rows[2][0] * u + rows[2][1] * v + rows[2][2] * w
        owners = 1
        for other, (p, q, r), back in others:
            d, e, f = x - p, y - q, z - r
            if _holds(other, *(row[0] * d + row[1] * e + row[2] * f for row in back)):
                owners += 1
        if owners > 1:
            theirs = 1.0 - 1.0 / owners
            for index, value in enumerate((1.0, x, y, z, x * x, x * y, x * z, y * y, y * z, z * z)):
                sums[index] += theirs * value
    amount, x, y, z, *second = (volume * value / max(1, count) for value in sums)
    return Moments(amount, (x, y, z), tuple(second))


def _spread(shape: Geometry, points: int) -> Iterator[Vector]:
    """Yield quasirandom points with uniform density in a shape, in its own frame."""
    for number in range(1, points + 1):
        s, t, u = (0.5 + number * step for step in _STEPS)
        s, t, u = s % 1.0, t % 1.0, u % 1.0
        if isinstance(shape, Box):
            yield shape.size[0] * (s - 0.5), shape.size[1] * (t - 0.5), shape.size[2] * (u - 0.5)
        elif isinstance(shape, Cylinder):
            radius, angle = shape.radius * sqrt(s), 2.0 * pi * t
            yield radius * cos(angle), radius * sin(angle), shape.length * (u - 0.5)
        elif isinstance(shape, Sphere):
            radius, angle, height = shape.radius * s ** (1.0 / 3.0), 2.0 * pi * t, 2.0 * u - 1.0
            across = radius * sqrt(1.0 - height * height)
            yield across * cos(angle), across * sin(angle), radius * height
        elif isinstance(shape, Capsule):
            radius = shape.radius
            point = (2.0 * radius * (s - 0.5), 2.0 * radius * (t - 0.5), (shape.length + 2.0 * radius) * (u - 0.5))
            if _holds(shape, *point):
                yield point


def _holds(shape: Geometry, x: float, y: float, z: float) -> bool:
    """Return whether a shape contains a point, which is in the frame of the shape."""
    if isinstance(shape, Box):
        return 2.0 * abs(x) <= shape.size[0] and 2.0 * abs(y) <= shape.size[1] and 2.0 * abs(z) <= shape.size[2]
    if isinstance(shape, Cylinder):
        return 2.0 * abs(z) <= shape.length and hypot(x, y) <= shape.radius
    if isinstance(shape, Sphere):
        return x * x + y * y + z * z <= shape.radius**2
    if isinstance(shape, Capsule):
        return hypot(x, y, max(abs(z) - shape.length / 2.0, 0.0)) <= shape.radius
    return False
