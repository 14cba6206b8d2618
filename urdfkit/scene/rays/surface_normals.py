"""Surface normals at the hit points of rays."""

from typing import Any

from urdfkit.scene.rays.compilation import inlined
from urdfkit.scene.rays.primitives import BOX, CAPSULE, CONE, CYLINDER, ELLIPSOID, SPHERE, STRIDE
from urdfkit.scene.rays.ray_packet import DX, HIT, OX, PART, REACH, WIDTH
from urdfkit.scene.rays.triangles import CORNERS


@inlined
def point(work: Any, shapes: Any, k: int, at: int) -> tuple[float, float, float]:
    """Return the hit point of ray `k` in the frame of the shape."""
    reach = work[REACH + k]
    x = work[OX + k] + reach * work[DX + k] - shapes[at + 9]
    y = work[OX + WIDTH + k] + reach * work[DX + WIDTH + k] - shapes[at + 10]
    z = work[OX + 2 * WIDTH + k] + reach * work[DX + 2 * WIDTH + k] - shapes[at + 11]
    return (
        shapes[at] * x + shapes[at + 3] * y + shapes[at + 6] * z,
        shapes[at + 1] * x + shapes[at + 4] * y + shapes[at + 7] * z,
        shapes[at + 2] * x + shapes[at + 5] * y + shapes[at + 8] * z,
    )


@inlined
def normal(work: Any, scene: Any, k: int) -> tuple[float, float, float]:
    """Return the unit normal in the world at the hit of ray `k`, towards the ray; zero without a hit."""
    shapes, kinds, _, _, _, _, _, _, corners = scene
    hit = int(work[HIT + k])
    if hit < 0:
        return 0.0, 0.0, 0.0
    at = hit * STRIDE
    if int(work[PART + k]) >= 0:
        u, v, w = triangle_normal(corners, CORNERS * int(work[PART + k]))
    else:
        p, q, r = point(work, shapes, k, at)
        u, v, w = solid_normal(kinds[hit], shapes[at + 12], shapes[at + 13], shapes[at + 14], p, q, r)
    nx, ny, nz = outwards(shapes, at, u, v, w)
    if nx * work[DX + k] + ny * work[DX + WIDTH + k] + nz * work[DX + 2 * WIDTH + k] > 0.0:
        return -nx, -ny, -nz
    return nx, ny, nz


@inlined
def outwards(shapes: Any, at: int, u: float, v: float, w: float) -> tuple[float, float, float]:
    """Rotate a vector from the frame of a shape to the world and normalize it; zero stays zero."""
    nx = shapes[at] * u + shapes[at + 1] * v + shapes[at + 2] * w
    ny = shapes[at + 3] * u + shapes[at + 4] * v + shapes[at + 5] * w
    nz = shapes[at + 6] * u + shapes[at + 7] * v + shapes[at + 8] * w
    length = (nx * nx + ny * ny + nz * nz) ** 0.5
    scale = 1.0 / length if length != 0.0 else 0.0
    return nx * scale, ny * scale, nz * scale


@inlined
def triangle_normal(corners: Any, at: int) -> tuple[float, float, float]:
    """Return a normal of a triangle, not normalized."""
    ax, ay, az = corners[at + 3], corners[at + 4], corners[at + 5]
    bx, by, bz = corners[at + 6], corners[at + 7], corners[at + 8]
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx


@inlined
def solid_normal(kind: int, a: float, b: float, c: float, x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return a normal of a solid at a point of its surface, in its frame; `a`, `b`, `c` are its size."""
    if kind == BOX:
        u, v, w = abs(x) - a, abs(y) - b, abs(z) - c
        if u >= v and u >= w:
            return x, 0.0, 0.0
        return (0.0, y, 0.0) if v >= w else (0.0, 0.0, z)
    if kind == CYLINDER:
        if abs(z) - b >= (x * x + y * y) ** 0.5 - a:
            return 0.0, 0.0, z
        return x, y, 0.0
    if kind == SPHERE:
        return x, y, z
    if kind == CAPSULE:
        return x, y, z - min(max(z, -b), b)
    if kind == CONE:
        slope = 0.5 * a / b
        if -(z + b) >= (x * x + y * y) ** 0.5 - slope * (b - z):
            return 0.0, 0.0, z
        return x, y, slope * slope * (b - z)
    if kind == ELLIPSOID:
        return x / (a * a), y / (b * b), z / (c * c)
    return 0.0, 0.0, 1.0
