"""Ellipsoids and cones as the convex hulls that the engine and the page know.

An ellipsoid is an icosphere of 642 corners, stretched, whose corners lie as far outside as its faces lie inside: along
every ray from the centre it is within `TOLERANCE` of the true surface. A cone has 48 corners round its base, which lie
on a circle larger than the base by the same rule: within 0.11 % of the radius.
"""

from __future__ import annotations

from functools import cache
from math import cos, pi

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import Cone, Ellipsoid
from urdfkit.scene import TriMesh

LEVEL = 3
"""How often the icosahedron's faces are parted in four."""
TOLERANCE = 0.0023
"""How far an ellipsoid's hull may be from it, as a part of the distance to the centre."""
CORNERS = 48
"""Corners round the base of a cone."""


def hull_of(geometry: Ellipsoid | Cone) -> TriMesh:
    """Return an ellipsoid, or a cone with its apex up and its origin half way up (gz-math, Cone.hh)."""
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
