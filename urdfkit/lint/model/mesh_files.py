"""Mesh files: where they are, and the box around one. trimesh is loaded only for a mesh that is there."""

from __future__ import annotations

import re

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path
    from typing import Any

    from urdfkit.description.urdf.robot import Link, Mesh, Vector
    from urdfkit.description.xml.element import Element
    from urdfkit.lint.facts.inertia.link_solids import Moments
    from urdfkit.lint.model.model import Model

LFS = b"version https://git-lfs.github.com/spec/"
"""How a Git LFS pointer begins."""


def meshes(model: Model) -> Iterator[tuple[Mesh, Element, Link]]:
    """Yield every mesh with its ``<mesh>`` element and link."""
    from urdfkit.description.urdf.robot import Mesh
    from urdfkit.lint.model.placement import shapes_of

    for link in model.robot.links:
        for item in shapes_of(link):
            geometry = item.element.find("geometry")
            element = geometry.find("mesh") if geometry is not None else None
            if isinstance(item.geometry, Mesh) and element is not None:
                yield item.geometry, element, link


def path_of(mesh: Mesh, model: Model) -> Path | None:
    """Return the file a mesh is in; None where it is not there."""
    from urdfkit.errors import ResourceError

    try:
        return model.expanded.packages.resolve(mesh.uri.strip(), model.expanded.path)
    except ResourceError:
        return None


def box(mesh: Mesh, model: Model) -> tuple[Vector, Vector] | None:
    """Return centre and size of the box around a mesh [m], scale included; None where it cannot be read."""
    from urdfkit.errors import UrdfkitError

    path = path_of(mesh, model)
    if path is None:
        return None
    try:
        from urdfkit.scene.meshes.loader import MeshLoader

        low, high = MeshLoader().load(path, mesh.scale).bounds.tolist()
    except (UrdfkitError, ImportError):
        return None
    centre = [(a + b) / 2.0 for a, b in zip(low, high, strict=True)]
    size = [b - a for a, b in zip(low, high, strict=True)]
    return (centre[0], centre[1], centre[2]), (size[0], size[1], size[2])


def missing(mesh: Mesh, model: Model) -> tuple[str, str] | None:
    """Return what of a mesh's URI is not there, ``package`` or ``file``, with its name or a hint; None where all is."""
    from urdfkit.errors import ResourceError

    uri = mesh.uri.strip()
    scheme, separator, rest = uri.partition("://")
    if separator and scheme in ("package", "model"):
        name = rest.partition("/")[0]
        try:
            model.expanded.packages.find(name)
        except ResourceError:
            return "package", name
    elif separator and scheme != "file":
        return None  # From the net: nobody knows.
    try:
        model.expanded.packages.resolve(uri, model.expanded.path)
    except ResourceError as error:
        return "file", str(error)
    return None


def is_absolute(uri: str) -> bool:
    """Whether a URI is a path that only one machine has."""
    return re.match(r"\s*(?:file:/+[^$]|/|[A-Za-z]:[\\/])", uri) is not None


def moments(mesh: Mesh, model: Model) -> tuple[Moments, str]:
    """Return what a mesh weighs about its own frame, scale included, and what had to be taken for it; see `Moments`.

    A closed surface is summed up over the tetrahedra between its triangles and the origin (Mirtich 1996 has the
    integrals); what is not closed is taken as its convex hull, and as the box around it where there is no scipy.

    Raises:
        ResourceError: it is not there, or broken.
        MissingDependencyError: trimesh is not installed.
    """
    import numpy as np

    from urdfkit.errors import MissingDependencyError
    from urdfkit.lint.facts.inertia.link_solids import Moments
    from urdfkit.scene.meshes.loader import MeshLoader

    path = model.expanded.packages.resolve(mesh.uri.strip(), model.expanded.path)
    triangles = MeshLoader().load(path, mesh.scale)
    points, indices = np.unique(triangles.vertices.astype(float), axis=0, return_inverse=True)
    faces = indices.reshape(-1)[triangles.faces]
    note = ""
    box = float(np.prod(np.ptp(points, axis=0)))
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    filled = abs(float(np.einsum("ij,ij", a, np.cross(b, c)))) / 6.0
    if not _is_closed(faces) or filled < 1e-6 * box:
        note = f"the surface of {path.name} is not closed: its convex hull is taken"
        try:
            import trimesh

            hull = trimesh.convex.convex_hull(trimesh.Trimesh(points, faces, process=False))
        except ImportError as error:
            raise MissingDependencyError(
                f"{path.name} is not closed, its hull needs scipy: pip install scipy"
            ) from error
        except Exception:
            return Moments(0.0, (0.0, 0.0, 0.0), (0.0,) * 6), f"{path.name} is flat: it has no volume"
        points, faces = np.asarray(hull.vertices, dtype=float), np.asarray(hull.faces)
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    volumes = np.einsum("ij,ij->i", a, np.cross(b, c)) / 6.0
    first = volumes @ (a + b + c) / 4.0
    corners = np.stack([a, b, c], axis=1)
    whole = corners.sum(axis=1)
    second = np.einsum("n,nci,ncj->ij", volumes, corners, corners) + np.einsum("n,ni,nj->ij", volumes, whole, whole)
    second /= 20.0
    sign = -1.0 if volumes.sum() < 0.0 else 1.0  # a surface inside out, or mirrored by its scale
    x, y, z = (sign * first).tolist()
    squares = tuple((sign * second[np.triu_indices(3)]).tolist())
    return Moments(abs(float(volumes.sum())), (x, y, z), squares), note


def _is_closed(faces: Any) -> bool:
    """Whether every edge of a surface is walked once in each direction."""
    import numpy as np

    faces = faces[(faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])]
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    size = int(edges.max(initial=0)) + 1
    forth, back = (np.sort(edges[:, i] * size + edges[:, 1 - i]) for i in (0, 1))
    return len(faces) > 0 and bool(np.array_equal(forth, back))
