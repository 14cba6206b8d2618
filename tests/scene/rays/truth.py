"""Where rays meet solids, worked out once more: in extended precision, in the world's frame, face by face."""

from __future__ import annotations

import numpy as np

from urdfkit.description.sdf import Cone, Ellipsoid, Plane
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere

Real = np.longdouble


def nearest(geometry, R, p, origin, direction) -> float:
    """Return the smallest positive distance at which a ray meets a solid's surface; infinite where it does not."""
    R, p, o, d = (np.asarray(x, dtype=Real) for x in (R, p, origin, direction))
    found = [t for t in _meetings(geometry, R, o - p, d) if t >= 0]
    return float(min(found, default=np.inf))


def _meetings(geometry, R, o, d):
    """Yield all distances at which a ray from `o`, relative to the solid's centre, meets its surface."""
    match geometry:
        case Sphere(radius=r):
            yield from _roots(d @ d, 2 * (o @ d), o @ o - Real(r) ** 2)
        case Box(size=size):
            for axis in range(3):
                n, half = R[:, axis], Real(size[axis]) / 2
                for side in (-half, half):
                    if (slope := n @ d) != 0:
                        t = (side - n @ o) / slope
                        at = o + t * d
                        others = [k for k in range(3) if k != axis]
                        if all(abs(R[:, k] @ at) <= Real(size[k]) / 2 for k in others):
                            yield t
        case Cylinder(radius=r, length=length):
            yield from (t for t in _side(R[:, 2], o, d, Real(r)) if abs(R[:, 2] @ (o + t * d)) <= Real(length) / 2)
            yield from _discs(R[:, 2], o, d, Real(r), Real(length) / 2)
        case Capsule(radius=r, length=length):
            z, half = R[:, 2], Real(length) / 2
            yield from (t for t in _side(z, o, d, Real(r)) if abs(z @ (o + t * d)) <= half)
            for end in (-half, half):
                c = o - end * z
                for t in _roots(d @ d, 2 * (c @ d), c @ c - Real(r) ** 2):
                    if (z @ (o + t * d)) * np.sign(end) >= half:
                        yield t
        case Cone(radius=r, length=length):
            z, half = R[:, 2], Real(length) / 2
            yield from (t for t in _slope(z, o, d, Real(r) / length, half) if abs(z @ (o + t * d)) <= half)
            yield from (t for t in _discs(z, o, d, Real(r), half) if z @ (o + t * d) < 0)
        case Ellipsoid(radii=radii):
            A = R @ np.diag(1 / np.asarray(radii, dtype=Real) ** 2) @ R.T
            yield from _roots(d @ A @ d, 2 * (o @ A @ d), o @ A @ o - 1)
        case Plane(normal=normal):
            n = R @ np.asarray(normal, dtype=Real)
            if n @ d != 0:
                yield -(n @ o) / (n @ d)


def _side(z, o, d, r):
    flat_o, flat_d = np.cross(z, o), np.cross(z, d)
    yield from _roots(flat_d @ flat_d, 2 * (flat_o @ flat_d), flat_o @ flat_o - r**2)


def _slope(z, o, d, k, half):
    """Yield where a ray meets the double cone of slope `k` about z whose apex is at `half`."""
    from_apex = o - half * z
    along_o, along_d = z @ from_apex, z @ d
    g = 1 + k**2
    yield from _roots(
        d @ d - g * along_d**2, 2 * (from_apex @ d - g * along_o * along_d), from_apex @ from_apex - g * along_o**2
    )


def _discs(z, o, d, r, half):
    for end in (-half, half):
        if (slope := z @ d) != 0:
            t = (end - z @ o) / slope
            at = o + t * d - end * z
            if at @ at <= r**2:
                yield t


def _roots(a, b, c):
    under = b * b - 4 * a * c
    if a != 0 and under >= 0:
        # The quadratic formula that does not subtract what is nearly equal (Numerical Recipes, 5.6).
        q = -(b + np.copysign(np.sqrt(under), b)) / 2
        yield q / a
        if q != 0:
            yield c / q
