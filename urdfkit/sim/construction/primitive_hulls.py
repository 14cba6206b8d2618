"""Convex hulls of ellipsoids and cones, which the engine and the viewer do not support as primitives.

An ellipsoid is a scaled icosphere of 642 vertices, whose vertices are as far outside the surface as its faces are
inside: along every ray from the centre, the deviation is at most `TOLERANCE`. The base of a cone has 48 vertices on a
circle that is larger than the base by the same rule; the deviation is at most 0.11 % of the radius.
"""

from functools import cache
from math import cos, pi

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import Cone, Ellipsoid
from urdfkit.scene import TriMesh

LEVEL = 3
"""Number of subdivisions of the icosahedron's faces."""
TOLERANCE = 0.0023
"""Maximum deviation of an ellipsoid's hull, relative to the distance from the centre."""
CORNERS = 48
"""Number of vertices of a cone's base."""


def hull_of(geometry: Ellipsoid | Cone) -> TriMesh:
    """Return the hull of an ellipsoid, or of a cone with its apex up and its origin at half its height (gz-math)."""
    if isinstance(geometry, Ellipsoid):
        points, faces = _unit_sphere()
        return TriMesh((points * np.array(geometry.radii)).astype(np.float32), faces)
    turn = np.arange(CORNERS) * 2 * pi / CORNERS
    radius = geometry.radius * 2 / (1 + cos(pi / CORNERS))
    half = geometry.length / 2
    ring = np.stack([radius * np.cos(turn), radius * np.sin(turn), np.full(CORNERS, -half)], axis=1)
    ends = np.array([[0.0, 0.0, half], [0.0, 0.0, -half]])
    following = (np.arange(CORNERS) + 1) % CORNERS
    around = np.arange(CORNERS)
    side = np.stack([around, following, np.full(CORNERS, CORNERS)], axis=1)
    base = np.stack([following, around, np.full(CORNERS, CORNERS + 1)], axis=1)
    return TriMesh(np.vstack([ring, ends]).astype(np.float32), np.vstack([side, base]).astype(np.int32))


@cache
def _unit_sphere() -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    import trimesh

    ball = trimesh.creation.icosphere(subdivisions=LEVEL)
    points, faces = np.asarray(ball.vertices, dtype=float), np.asarray(ball.faces, dtype=np.int32)
    inmost = float(np.abs(np.einsum("ij,ij->i", ball.face_normals, points[faces[:, 0]])).min())
    return points * 2 / (1 + inmost), faces
