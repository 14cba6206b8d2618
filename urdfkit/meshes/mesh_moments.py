"""Volume moments of a mesh, summed over the tetrahedra of its triangles."""

from typing import Any

import numpy as np

from urdfkit.description.urdf.volume_moments import Moments
from urdfkit.errors import MissingDependencyError
from urdfkit.linear_algebra import matmul
from urdfkit.meshes.triangle_mesh import TriMesh


def moments(triangles: TriMesh, name: str) -> tuple[Moments, str]:
    """Return the moments of a mesh in its own frame, and the assumption made about an open surface.

    A closed surface is integrated over the tetrahedra between its triangles and the origin (integrals: Mirtich 1996).
    An open surface is replaced by its convex hull.

    Args:
        triangles: the mesh, scale included.
        name: name of the file, for the message.

    Raises:
        MissingDependencyError: the surface is open, and scipy is not installed.
    """
    points, indices = np.unique(triangles.vertices.astype(float), axis=0, return_inverse=True)
    faces = indices.reshape(-1)[triangles.faces]
    note = ""
    box = float(np.prod(np.ptp(points, axis=0)))
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    filled = abs(float(np.einsum("ij,ij", a, np.cross(b, c)))) / 6.0
    if not _is_closed(faces) or filled < 1e-6 * box:
        note = f"the surface of {name} is not closed: its convex hull is used"
        try:
            import trimesh

            hull = trimesh.convex.convex_hull(trimesh.Trimesh(points, faces, process=False))
        except ImportError as error:
            raise MissingDependencyError(
                f"{name} is not closed, and its convex hull needs scipy: pip install scipy"
            ) from error
        except Exception:
            return _flat(name)
        points, faces = np.asarray(hull.vertices, dtype=float), np.asarray(hull.faces)
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
    if note and abs(float(volumes.sum())) < 1e-9 * float(np.ptp(points, axis=0).max()) ** 3:  # points may be joggled
        return _flat(name)
    first = matmul(volumes, a + b + c) / 4.0
    corners = np.stack([a, b, c], axis=1)
    whole = corners.sum(axis=1)
    second = np.einsum("n,nci,ncj->ij", volumes, corners, corners) + np.einsum("n,ni,nj->ij", volumes, whole, whole)
    second /= 20.0
    sign = -1.0 if volumes.sum() < 0.0 else 1.0  # negative if the surface is inside out or mirrored by its scale
    x, y, z = (sign * first).tolist()
    squares = tuple((sign * second[np.triu_indices(3)]).tolist())
    return Moments(abs(float(volumes.sum())), (x, y, z), squares), note


def _flat(name: str) -> tuple[Moments, str]:
    return Moments(0.0, (0.0, 0.0, 0.0), (0.0,) * 6), f"{name} is flat: it has no volume"


def _is_closed(faces: Any) -> bool:
    """Return whether every edge of a surface occurs once in each direction."""
    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    size = int(edges.max(initial=0)) + 1
    forth, back = (np.sort(edges[:, i] * size + edges[:, 1 - i]) for i in (0, 1))
    return len(faces) > 0 and bool(np.array_equal(forth, back))
