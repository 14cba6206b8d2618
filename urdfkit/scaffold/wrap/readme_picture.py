"""A picture of a robot as PNG, with nothing but Python: the solids it is made of, and their shadow on the ground.

Seen from far away, from the front and above. The same robot gives the same picture.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable
from math import hypot

from urdfkit.description.urdf.geometry import rotate
from urdfkit.description.urdf.robot import Robot, Vector
from urdfkit.scaffold.wrap.picture_solids import Beam, Solid, solids_of

WIDTH, HEIGHT = 480, 320
"""Of the picture [px]."""

_MARGIN = 0.08
_SEEN_FROM: Vector = (0.72, 0.48, 0.5)
_LIT_FROM: Vector = (0.35, 0.75, 1.1)
_AMBIENT = 0.42
_GROUND, _SHADOW = (0.95, 0.955, 0.965), (0.80, 0.81, 0.83)
_EDGE = 0.04
"""Where neighbours differ by more, a pixel is the mean of four places in it [of 1]."""

_WITHIN = ((-0.25, -0.25), (0.25, -0.25), (-0.25, 0.25), (0.25, 0.25))


def drawing_of(robot: Robot) -> bytes | None:
    """Return the picture of a robot as PNG; None where there is nothing to see but meshes.

    Args:
        robot: a tree.
    """
    solids = solids_of(robot)
    return _png(_Plate(solids).pixels()) if solids else None


_Span = tuple[float, float, int]


class _Plate:
    """The plane that is looked through: what each place of it sees."""

    def __init__(self, solids: list[Solid]) -> None:
        back = _unit(_SEEN_FROM)
        side = _unit(_cross((0.0, 0.0, 1.0), back))
        up = _cross(back, side)
        corners = [corner for solid in solids for corner in solid.corners()]
        ground = min(corner[2] for corner in corners)
        light = _unit(_LIT_FROM)
        cast = [_drop(corner, light, ground) for corner in corners]
        across = [_dot(side, corner) for corner in (*corners, *cast)]
        along = [_dot(up, corner) for corner in (*corners, *cast)]
        width, height = max(across) - min(across), max(along) - min(along)
        pixel = max(width / WIDTH, height / HEIGHT) / (1 - 2 * _MARGIN)
        right, down = _scaled(side, pixel), _scaled(up, -pixel)
        away = max(_dot(back, corner) for corner in corners) + 1.0
        left = (max(across) + min(across)) / 2 - pixel * (WIDTH - 1) / 2
        top = (max(along) + min(along)) / 2 + pixel * (HEIGHT - 1) / 2
        start = _sum(_sum(_scaled(side, left), _scaled(up, top)), _scaled(back, away))
        self._solids, self._light = solids, light
        self._seen = [Beam(solid, start, right, down, _scaled(back, -1.0)) for solid in solids]
        # Where each ray meets the ground: from there the light is looked for.
        on, rise = _drop(start, back, ground), back
        self._lit = [Beam(solid, on, _level(right, rise), _level(down, rise), light) for solid in solids]

        def place(corner: Vector) -> tuple[float, float]:
            return (_dot(side, corner) - left) / pixel, (top - _dot(up, corner)) / pixel

        self._boxes = [_box(map(place, solid.corners())) for solid in solids]
        shadows = ((_drop(corner, light, ground) for corner in solid.corners()) for solid in solids)
        self._shadows = [_box(map(place, corners)) for corners in shadows]

    def pixels(self) -> list[list[Vector]]:
        """Return the colours, row by row, 0..1."""
        found = [self._row(v) for v in range(HEIGHT)]
        edges = [
            (u, v)
            for v in range(HEIGHT - 1)
            for u in range(WIDTH - 1)
            if _differ(found[v][u], found[v][u + 1]) or _differ(found[v][u], found[v + 1][u])
        ]
        near = {(u + du, v + dv) for u, v in edges for du, dv in ((0, 0), (1, 0), (0, 1))}
        for u, v in sorted(near):
            parts = [self._colour(u + du, v + dv, *self._across(v + dv)) for du, dv in _WITHIN]
            found[v][u] = _scaled(_sum(_sum(parts[0], parts[1]), _sum(parts[2], parts[3])), 0.25)
        return found

    def _row(self, v: int) -> list[Vector]:
        seen, lit = self._across(v)
        return [self._colour(u, v, seen, lit) for u in range(WIDTH)] if seen or lit else [_GROUND] * WIDTH

    def _across(self, v: float) -> tuple[list[_Span], list[_Span]]:
        """Return which solids, and which shadows, there may be in a row: from where to where, and its number."""
        seen, lit = (
            [(low_u, high_u, k) for k, (low_u, low_v, high_u, high_v) in enumerate(boxes) if low_v <= v <= high_v]
            for boxes in (self._boxes, self._shadows)
        )
        return seen, lit

    def _colour(self, u: float, v: float, seen: list[_Span], lit: list[_Span]) -> Vector:
        nearest, found = float("inf"), None
        for low, high, k in seen:
            if low <= u <= high and (met := self._seen[k].meet(u, v)) is not None and met[0] < nearest:
                nearest, found = met[0], (self._solids[k], met[1])
        if found is not None:
            solid, normal = found
            shine = max(0.0, _dot(rotate(solid.turn, normal), self._light))
            return _scaled(solid.rgb, min(1.0, _AMBIENT + (1.1 - _AMBIENT) * shine))
        for low, high, k in lit:
            if low <= u <= high and (met := self._lit[k].meet(u, v)) is not None and met[0] > -1e-9:
                return _SHADOW
        return _GROUND


def _box(places: Iterable[tuple[float, float]]) -> tuple[float, float, float, float]:
    us, vs = zip(*places, strict=True)
    return min(us) - 1, min(vs) - 1, max(us) + 1, max(vs) + 1


def _drop(point: Vector, direction: Vector, ground: float) -> Vector:
    """Return where a line meets the ground."""
    return _sum(point, _scaled(direction, (ground - point[2]) / direction[2]))


def _level(step: Vector, direction: Vector) -> Vector:
    """Return a step as its foot on the ground takes it, seen along `direction`."""
    return _drop(step, direction, 0.0)


def _differ(one: Vector, other: Vector) -> bool:
    return abs(one[0] - other[0]) + abs(one[1] - other[1]) + abs(one[2] - other[2]) > _EDGE


def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def _sum(a: Vector, b: Vector) -> Vector:
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def _scaled(a: Vector, by: float) -> Vector:
    return a[0] * by, a[1] * by, a[2] * by


def _unit(a: Vector) -> Vector:
    return _scaled(a, 1 / hypot(*a))


def _png(pixels: list[list[Vector]]) -> bytes:
    """Return the file: 8 bits a channel, each row as differences to the one above (filter 2)."""
    above, rows = bytes(3 * WIDTH), bytearray()
    for line in pixels:
        row = bytes(round(255 * channel) for pixel in line for channel in pixel)
        rows.append(2)
        rows += bytes((a - b) & 255 for a, b in zip(row, above, strict=True))
        above = row
    header = struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 2, 0, 0, 0)
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(bytes(rows), 9)), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks
    )
