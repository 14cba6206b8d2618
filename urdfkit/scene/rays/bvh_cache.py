"""Trees over the triangles of meshes, built once per mesh and stored in the user's cache folder."""

import hashlib
import io
import os
import sys
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from urdfkit.atomic import write_bytes
from urdfkit.errors import ResourceError
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.rays.kernels import kernel

LEAF = 4
"""Triangles per leaf: a packet tests them faster than two more boxes."""

KEPT_FROM = 5_000
"""Minimum number of triangles of a cached tree: smaller trees are built faster than read."""


@dataclass(frozen=True, eq=False)
class MeshTree:
    """The tree of a mesh, and its triangles in the order of the leaves.

    Attributes:
        bounds: boxes of the nodes in the mesh's frame [m], the root first; shape (nodes, 6).
        links: of a leaf, its first triangle and its size; else the first of two children and zero; shape (nodes, 2).
        order: index in the mesh of each triangle; shape (triangles,).
        corners: one corner of each triangle and the edges to the others [m]; shape (triangles, 9).
    """

    bounds: NDArray[np.float64]
    links: NDArray[np.int64]
    order: NDArray[np.int64]
    corners: NDArray[np.float64]


def mesh_tree(mesh: TriMesh) -> MeshTree:
    """Return the tree of a mesh, from the cache if it has a valid one."""
    a, b, c = (mesh.vertices[mesh.faces[:, k]].astype(float) for k in range(3))
    kept = _place(mesh) if len(mesh.faces) >= KEPT_FROM else None
    found = _read(kept, len(a)) if kept is not None else None
    if found is None:
        found = _build(np.hstack([np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)]))
        if kept is not None:
            _write(kept, found)
    bounds, links, order = found
    return MeshTree(bounds, links, order, np.ascontiguousarray(np.hstack([a, b - a, c - a])[order]))


Parts = tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.int64]]


def _build(boxes: NDArray[np.float64]) -> Parts:
    from urdfkit.scene.rays.bvh import SCRATCH

    count = len(boxes)
    order = np.empty(count, dtype=np.int64)
    bounds = np.empty((2 * count - 1, 6))
    links = np.empty((2 * count - 1, 2), dtype=np.int64)
    nodes = kernel("build")(np.ascontiguousarray(boxes), order, bounds, links, LEAF, np.empty(SCRATCH))
    return bounds[:nodes].copy(), links[:nodes].copy(), order


def cache_folder() -> Path:
    """Return the cache folder of the user."""
    home = Path.home()
    if sys.platform == "darwin":
        return home / "Library" / "Caches" / "urdfkit"
    place = os.environ.get("LOCALAPPDATA" if sys.platform == "win32" else "XDG_CACHE_HOME")
    return (Path(place) if place and Path(place).is_absolute() else home / ".cache") / "urdfkit"


@lru_cache(maxsize=1)
def _version() -> str:
    return hashlib.sha256(Path(__file__).with_name("bvh.py").read_bytes()).hexdigest()[:8]


def _place(mesh: TriMesh) -> Path | None:
    try:
        folder = cache_folder() / "trees"
    except RuntimeError:  # the home folder is unknown
        return None
    return folder / f"{mesh.hash}-{_version()}.npz"


def _read(path: Path, count: int) -> Parts | None:
    """Return a cached tree; None if it is missing or invalid."""
    try:
        content = path.read_bytes()
        if hashlib.sha256(content[32:]).digest() != content[:32]:
            return None
        with np.load(io.BytesIO(content[32:]), allow_pickle=False) as kept:
            bounds, links, order = kept["bounds"], kept["links"], kept["order"]
    except (OSError, ValueError, KeyError, EOFError):
        return None
    whole = bounds.shape == (len(links), 6) and links.shape[1:] == (2,) and order.shape == (count,)
    return (bounds, links, order) if whole else None


def _write(path: Path, parts: Parts) -> None:
    """Store a tree in the cache, if the folder is writable."""
    file = io.BytesIO()
    np.savez(file, bounds=parts[0], links=parts[1], order=parts[2])
    content = file.getvalue()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        write_bytes(path, hashlib.sha256(content).digest() + content)
    except (OSError, ResourceError):
        return
