"""Intersection of ray packets with box, sphere, cylinder, capsule, ellipsoid, cone and plane, in closed form.

For each solid, the interval of a ray inside it is computed; the hit is its start, or its end if the ray begins inside.
Of two shapes at the same distance the one with the smaller index counts, independent of the tree.
"""

from math import sqrt
from typing import Any

from urdfkit.scene.rays.compilation import compiled, inlined
from urdfkit.scene.rays.ray_packet import DX, DY, DZ, FAR, HIT, OX, OY, OZ, PART, REACH, WIDTH

BOX, SPHERE, CYLINDER, CAPSULE, ELLIPSOID, PLANE, MESH, CONE = range(8)
"""Kinds of shapes."""

STRIDE = 16
"""Numbers per shape: rotation by rows (9) and position (3) in the world, size (3), one spare."""


@inlined
def record_hit(packet: Any, k: int, shape: float, near: float, enter: float, leave: float) -> None:
    """Record a hit of ray `k` if it is nearer than the previous hits."""
    t = enter if enter >= near else leave
    reach, hit = packet[REACH + k], packet[HIT + k]
    better = (enter <= leave) & (t >= near) & ((t < reach) | ((t == reach) & (shape < hit)))
    packet[REACH + k] = t if better else reach
    packet[HIT + k] = shape if better else hit
    packet[PART + k] = -1.0 if better else packet[PART + k]


@inlined
def ray_in_frame(packet: Any, k: int, frame: Any) -> Any:
    """Return origin and direction of ray `k` in the frame of a shape."""
    r00, r01, r02, r10, r11, r12, r20, r21, r22, px, py, pz = frame
    x, y, z = packet[OX + k] - px, packet[OY + k] - py, packet[OZ + k] - pz
    dx, dy, dz = packet[DX + k], packet[DY + k], packet[DZ + k]
    return (
        r00 * x + r10 * y + r20 * z,
        r01 * x + r11 * y + r21 * z,
        r02 * x + r12 * y + r22 * z,
        r00 * dx + r10 * dy + r20 * dz,
        r01 * dx + r11 * dy + r21 * dz,
        r02 * dx + r12 * dy + r22 * dz,
    )


@inlined
def frame_of(shapes: Any, at: int) -> Any:
    """Return rotation and position of a shape."""
    return (
        shapes[at], shapes[at + 1], shapes[at + 2], shapes[at + 3], shapes[at + 4], shapes[at + 5],
        shapes[at + 6], shapes[at + 7], shapes[at + 8], shapes[at + 9], shapes[at + 10], shapes[at + 11],
    )  # fmt: skip


@inlined
def slab(o: float, d: float, half: float) -> tuple[float, float]:
    """Return the distances at which a ray enters and leaves -half..half along one axis."""
    inverse = 1.0 / d if d != 0.0 else FAR
    s = abs(half * inverse)
    middle = -o * inverse
    return middle - s, middle + s


@compiled
def box(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at a box; its size is half the edge lengths."""
    frame = frame_of(shapes, at)
    a, b, c = shapes[at + 12], shapes[at + 13], shapes[at + 14]
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        x0, x1 = slab(x, dx, a)
        y0, y1 = slab(y, dy, b)
        z0, z1 = slab(z, dz, c)
        record_hit(packet, k, shape, near, max(x0, y0, z0), min(x1, y1, z1))


@compiled
def sphere(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at a sphere; its size is its radius."""
    px, py, pz, radius = shapes[at + 9], shapes[at + 10], shapes[at + 11], shapes[at + 12]
    for k in range(WIDTH):
        x, y, z = packet[OX + k] - px, packet[OY + k] - py, packet[OZ + k] - pz
        dx, dy, dz = packet[DX + k], packet[DY + k], packet[DZ + k]
        enter, leave = ball(x, y, z, dx, dy, dz, radius)
        record_hit(packet, k, shape, near, enter, leave)


@inlined
def ball(x: float, y: float, z: float, dx: float, dy: float, dz: float, radius: float) -> tuple[float, float]:
    """Return the distances at which a ray of unit direction enters and leaves a sphere about the origin.

    The foot of the perpendicular avoids cancellation for distant origins (Haines et al., *Precision Improvements for
    Ray/Sphere Intersection*, Ray Tracing Gems, 2019).
    """
    foot = -(x * dx + y * dy + z * dz)
    lx, ly, lz = x + foot * dx, y + foot * dy, z + foot * dz
    under = radius * radius - (lx * lx + ly * ly + lz * lz)
    half = sqrt(max(under, 0.0))
    return (foot - half if under >= 0.0 else FAR), (foot + half if under >= 0.0 else -FAR)


@inlined
def infinite_cylinder(x: float, y: float, dx: float, dy: float, radius: float) -> tuple[float, float]:
    """Return the distances at which a ray enters and leaves an infinite cylinder about z."""
    a = dx * dx + dy * dy
    inverse = 1.0 / a if a > 1e-200 else FAR
    foot = -(x * dx + y * dy) * inverse
    lx, ly = x + foot * dx, y + foot * dy
    under = radius * radius - (lx * lx + ly * ly)
    half = sqrt(max(under, 0.0) * inverse)
    parallel = a <= 1e-200
    within = x * x + y * y <= radius * radius
    enter = foot - half if under >= 0.0 else FAR
    leave = foot + half if under >= 0.0 else -FAR
    return (
        (-FAR if within else FAR) if parallel else enter,
        (FAR if within else -FAR) if parallel else leave,
    )


@compiled
def cylinder(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at a cylinder about z; its size is radius and half its length."""
    frame = frame_of(shapes, at)
    radius, half = shapes[at + 12], shapes[at + 13]
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        z0, z1 = slab(z, dz, half)
        r0, r1 = infinite_cylinder(x, y, dx, dy, radius)
        record_hit(packet, k, shape, near, max(z0, r0), min(z1, r1))


@compiled
def capsule(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at a capsule about z; its size is radius and half the length of its cylindrical part."""
    frame = frame_of(shapes, at)
    radius, half = shapes[at + 12], shapes[at + 13]
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        z0, z1 = slab(z, dz, half)
        r0, r1 = infinite_cylinder(x, y, dx, dy, radius)
        a0, a1 = ball(x, y, z - half, dx, dy, dz, radius)
        b0, b1 = ball(x, y, z + half, dx, dy, dz, radius)
        # The union is convex: the ray is inside from the first entry to the last exit.
        t0, t1 = max(z0, r0), min(z1, r1)
        t0, t1 = (t0 if t0 <= t1 else FAR), (t1 if t0 <= t1 else -FAR)
        record_hit(packet, k, shape, near, min(t0, a0, b0), max(t1, a1, b1))


@compiled
def ellipsoid(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at an ellipsoid; its size is its radii. Scaling to a unit sphere does not change ray parameters."""
    frame = frame_of(shapes, at)
    a, b, c = 1.0 / shapes[at + 12], 1.0 / shapes[at + 13], 1.0 / shapes[at + 14]
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        x, y, z, dx, dy, dz = x * a, y * b, z * c, dx * a, dy * b, dz * c
        inverse = 1.0 / (dx * dx + dy * dy + dz * dz)
        foot = -(x * dx + y * dy + z * dz) * inverse
        lx, ly, lz = x + foot * dx, y + foot * dy, z + foot * dz
        under = 1.0 - (lx * lx + ly * ly + lz * lz)
        half = sqrt(max(under, 0.0) * inverse)
        enter = foot - half if under >= 0.0 else FAR
        record_hit(packet, k, shape, near, enter, foot + half)


@compiled
def cone(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at a cone about z, apex up; its size is the radius of its base and half its length.

    The inside is ``x² + y² ≤ k²·(half - z)²`` between base and apex. Distances are measured from the point of the ray
    nearest to the cone's centre, which avoids cancellation for distant origins.
    """
    frame = frame_of(shapes, at)
    radius, half = shapes[at + 12], shapes[at + 13]
    k2 = (0.5 * radius / half) ** 2
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        foot = -(x * dx + y * dy + z * dz)
        x, y, z = x + foot * dx, y + foot * dy, z + foot * dz
        w = half - z
        a = dx * dx + dy * dy - k2 * dz * dz
        a = a if abs(a) > 1e-200 else 1e-200
        b = x * dx + y * dy + k2 * w * dz
        c = x * x + y * y - k2 * w * w
        under = b * b - a * c
        q = -(b + sqrt(max(under, 0.0)) * (1.0 if b >= 0.0 else -1.0))
        one, two = q / a, (c / q if q != 0.0 else q / a)
        first, last = min(one, two), max(one, two)
        # A flat ray is inside between its roots, a steep one after the second or before the first root.
        flat, down = a > 0.0, dz < 0.0
        t0 = first if flat else (last if down else -FAR)
        t1 = last if flat else (FAR if down else first)
        none = flat & (under < 0.0)
        z0, z1 = slab(z, dz, half)
        enter, leave = max(t0, z0), min(t1, z1)
        record_hit(packet, k, shape, near, FAR if none else foot + enter, -FAR if none else foot + leave)


@compiled
def plane(packet: Any, shapes: Any, at: int, shape: float, near: float) -> None:
    """Cast a packet at a rectangle in the xy plane of a frame, from either side; its size is half the edge lengths."""
    frame = frame_of(shapes, at)
    a, b = shapes[at + 12], shapes[at + 13]
    for k in range(WIDTH):
        x, y, z, dx, dy, dz = ray_in_frame(packet, k, frame)
        t = -z / dz if dz != 0.0 else FAR
        on = (abs(x + t * dx) <= a) & (abs(y + t * dy) <= b) & (t < FAR)
        record_hit(packet, k, shape, near, t if on else FAR, t if on else -FAR)
