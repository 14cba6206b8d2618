"""The solids that a robot is made of, and where parallel rays meet them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import inf, sqrt
from typing import Literal

from urdfkit.description.urdf.geometry import Rotation, compose, link_poses, rotate, rotation_of, transpose
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Robot, Sphere, Vector

_GREY = (0.7, 0.7, 0.7)


@dataclass(frozen=True, slots=True)
class Solid:
    """A box, a ball, or a cylinder along its z.

    Attributes:
        kind: which.
        half: half its extent along its own axes [m].
        turn: its rotation in the world.
        at: its middle in the world [m].
        rgb: 0..1.
    """

    kind: Literal["box", "sphere", "cylinder"]
    half: Vector
    turn: Rotation
    at: Vector
    rgb: Vector

    def corners(self) -> Iterator[Vector]:
        """Yield the corners of the box it is in, in the world [m]."""
        a, b, c = self.half
        for x in (-a, a):
            for y in (-b, b):
                for z in (-c, c):
                    turned = rotate(self.turn, (x, y, z))
                    yield (self.at[0] + turned[0], self.at[1] + turned[1], self.at[2] + turned[2])


def solids_of(robot: Robot) -> list[Solid]:
    """Return what is seen of a robot whose joints are at zero, or at the nearest end of their range; without meshes.

    Args:
        robot: a tree.
    """
    poses = link_poses(robot)
    named = {material.name: material.rgba for material in robot.materials if material.rgba is not None}
    found = []
    for link in robot.link_by_name_in_order():
        for visual in link.visuals:
            if link.name not in poses or (extent := _extent(visual.geometry)) is None:
                continue
            kind, half = extent
            pose = compose(poses[link.name], visual.origin)
            material = visual.material
            rgba = (material.rgba or named.get(material.name)) if material else None
            found.append(Solid(kind, half, rotation_of(pose.rpy), pose.xyz, rgba[:3] if rgba else _GREY))
    return found


def _extent(geometry: Geometry | None) -> tuple[Literal["box", "sphere", "cylinder"], Vector] | None:
    match geometry:
        case Box(size=(x, y, z)):
            return "box", (x / 2, y / 2, z / 2)
        case Sphere(radius=r):
            return "sphere", (r, r, r)
        case Cylinder(radius=r, length=length):
            return "cylinder", (r, r, length / 2)
        case Capsule(radius=r, length=length):
            return "cylinder", (r, r, length / 2 + r)
    return None


class Beam:
    """Parallel rays that may meet a solid: one per place (u, v) of a plane.

    Args:
        solid: what they may meet.
        start: where the ray of (0, 0) begins, in the world [m].
        right: from a ray to the next in u [m].
        down: from a ray to the next in v [m].
        direction: of all, of length 1.
    """

    def __init__(self, solid: Solid, start: Vector, right: Vector, down: Vector, direction: Vector) -> None:
        back = transpose(solid.turn)
        self._solid = solid
        self._start = rotate(back, (start[0] - solid.at[0], start[1] - solid.at[1], start[2] - solid.at[2]))
        self._right, self._down, self._along = rotate(back, right), rotate(back, down), rotate(back, direction)

    def meet(self, u: float, v: float) -> tuple[float, Vector] | None:
        """Return how far the solid is along a ray [m], and its normal there in its own axes; None if beside.

        Args:
            u: which ray, to the right.
            v: which ray, down.
        """
        (sx, sy, sz), (rx, ry, rz), (dx, dy, dz) = self._start, self._right, self._down
        origin = (sx + u * rx + v * dx, sy + u * ry + v * dy, sz + u * rz + v * dz)
        if self._solid.kind == "box":
            return self._slabs(origin, 3)
        if self._solid.kind == "sphere":
            return self._round(origin, 3)
        ends, tube = self._slabs(origin, 3), self._round(origin, 2)
        # The ray is in the cylinder where it is between the ends and in the tube: from the later of the two on.
        if ends is None or tube is None:
            return None
        low = self._slab_z(origin)
        if tube[0] >= low[0]:
            return tube if tube[0] <= low[1] else None
        x, y = origin[0] + low[0] * self._along[0], origin[1] + low[0] * self._along[1]
        inside = x * x + y * y <= self._solid.half[0] ** 2
        return (low[0], (0.0, 0.0, -1.0 if self._along[2] > 0 else 1.0)) if inside else None

    def _slab_z(self, origin: Vector) -> tuple[float, float]:
        along, half = self._along[2], self._solid.half[2]
        if abs(along) < 1e-12:
            return (-inf, inf) if abs(origin[2]) <= half else (inf, -inf)
        one, other = (-half - origin[2]) / along, (half - origin[2]) / along
        return (one, other) if one < other else (other, one)

    def _slabs(self, origin: Vector, count: int) -> tuple[float, Vector] | None:
        enter, leave, axis = -inf, inf, 0
        for k in range(count):
            o, d, half = origin[k], self._along[k], self._solid.half[k]
            if abs(d) < 1e-12:
                if abs(o) > half:
                    return None
                continue
            near, far = ((-half - o) / d, (half - o) / d) if d > 0 else ((half - o) / d, (-half - o) / d)
            if near > enter:
                enter, axis = near, k
            if far < leave:
                leave = far
            if enter > leave:
                return None
        normal = [0.0, 0.0, 0.0]
        normal[axis] = -1.0 if self._along[axis] > 0 else 1.0
        return enter, (normal[0], normal[1], normal[2])

    def _round(self, origin: Vector, count: int) -> tuple[float, Vector] | None:
        a = sum(self._along[k] * self._along[k] for k in range(count))
        if a < 1e-12:
            return None
        b = sum(origin[k] * self._along[k] for k in range(count))
        r = self._solid.half[0]
        c = sum(origin[k] * origin[k] for k in range(count)) - r * r
        if (under := b * b - a * c) < 0:
            return None
        t = (-b - sqrt(under)) / a
        x, y, z = (origin[k] + t * self._along[k] for k in range(3))
        return t, (x / r, y / r, z / r if count == 3 else 0.0)
