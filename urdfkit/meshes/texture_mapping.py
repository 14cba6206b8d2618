"""Textures of visuals with the ``<texture>`` of a URDF material, for meshes with texture coordinates and for solids.

A solid becomes a mesh. The image is upright on the sides of a box, and has x to the right on its top and bottom. It is
wrapped once round a cylinder, whose ends show circles of the image. On a sphere it is an equirectangular map.
"""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Sphere
from urdfkit.errors import ResourceError
from urdfkit.linear_algebra import Array
from urdfkit.meshes.picture_files import picture_fault, unreadable
from urdfkit.meshes.textures import Texture, read_texture
from urdfkit.meshes.triangle_mesh import TriMesh

AROUND = 64
"""Facets around."""


class Wrapper:
    """Applies textures to shapes; reads each image once.

    Args:
        resolve: returns the file of a name; raises ResourceError.
    """

    def __init__(self, resolve: Callable[[str], Path]) -> None:
        self._resolve = resolve
        self._textures: dict[str, Texture | None] = {}
        self._broken: dict[str, str] = {}

    def wrapped(self, geometry: Geometry, mesh: TriMesh | None, name: str) -> TriMesh | None:
        """Return a shape with a texture.

        Args:
            geometry: geometry of the shape.
            mesh: its triangles, if it is a mesh.
            name: name of the image in the description.

        Returns:
            The mesh with the texture where its file names no material, as in RViz; if the image is missing or invalid,
            the mesh with its name in `missing`; None without texture coordinates.
        """
        if name not in self._textures:
            try:
                path = self._resolve(name)
                self._textures[name] = read_texture(path)
            except (ResourceError, FileNotFoundError):
                self._textures[name] = None
            except (OSError, ValueError):
                self._textures[name] = None
                self._broken[name] = _fault(path)
        texture = self._textures[name]
        found = mesh if mesh is not None else solid(geometry)
        if texture is None or found is None:
            broken = (*found.broken, (name, self._broken[name])) if found and name in self._broken else ()
            return found and replace(found, missing=(*found.missing, name), broken=broken)
        if found.uv is None:
            return None
        if found.has_own_colors:
            return _filled(found, texture)
        wrapped = np.zeros(len(found.faces), dtype=np.int32)
        return replace(found, textures=(texture,), face_textures=wrapped, missing=(), broken=())


def _fault(path: Path) -> str:
    """Return why the image of a file cannot be read."""
    try:
        return picture_fault(path) or unreadable(b"?")
    except OSError as error:
        return f"cannot be read: {error.strerror}"


def _filled(mesh: TriMesh, texture: Texture) -> TriMesh:
    """Return a mesh with the texture on the triangles for which its file names no material."""
    if mesh.open_vertices is None:
        return mesh
    which = np.full(len(mesh.faces), -1, dtype=np.int32) if mesh.face_textures is None else mesh.face_textures.copy()
    which[mesh.open_vertices[mesh.faces[:, 0]]] = len(mesh.textures)
    return replace(mesh, textures=(*mesh.textures, texture), face_textures=which)


def solid(geometry: Geometry) -> TriMesh | None:
    """Return the triangles of a solid with texture coordinates; None for a mesh."""
    match geometry:
        case Box(size=size):
            return _box(np.array(size))
        case Cylinder(radius=radius, length=length):
            rim, z = np.array([0.0, 1.0, 1.0, 1.0, 1.0, 0.0]), np.array([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0])
            out, up = np.array([0.0, 0, 1, 1, 0, 0]), np.array([-1.0, -1, 0, 0, 1, 1])
            found = _turned(radius * rim, length / 2 * z, out, up, np.array([0.0, 0, 0, 1, 1, 1]))
            ends = np.abs(found.normals[:, 2]) > 0.5 if found.normals is not None else np.zeros(0, dtype=bool)
            assert found.uv is not None
            flat = found.vertices[:, :2] / (2 * radius) * np.where(found.vertices[:, 2:] > 0, (1, 1), (1, -1)) + 0.5
            return replace(found, uv=np.where(ends[:, None], flat, found.uv).astype(np.float32))
        case Sphere(radius=radius):
            angle = np.linspace(-np.pi / 2, np.pi / 2, AROUND // 2 + 1)
            cos, sin = np.cos(angle), np.sin(angle)
            return _turned(radius * cos, radius * sin, cos, sin, angle / np.pi + 0.5)
        case Capsule(radius=radius, length=length):
            half = np.linspace(0.0, np.pi / 2, AROUND // 4 + 1)
            angle = np.concatenate([-half[::-1], half])
            lift = np.where(np.arange(len(angle)) < len(half), -length / 2, length / 2)
            z = radius * np.sin(angle) + lift
            return _turned(radius * np.cos(angle), z, np.cos(angle), np.sin(angle), (z - z[0]) / (z[-1] - z[0]))
    return None


def _box(size: Array) -> TriMesh:
    x, y, z = np.eye(3)
    vertices, normals = [], []
    for normal, right, up in ((x, y, z), (-x, -y, z), (y, -x, z), (-y, x, z), (z, x, y), (-z, x, -y)):
        corners = [normal + a * right + b * up for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        vertices += [corner * size / 2 for corner in corners]
        normals += [normal] * 4
    faces = np.concatenate([np.array([[0, 1, 2], [0, 2, 3]]) + 4 * side for side in range(6)])
    uv = np.tile([[0, 0], [1, 0], [1, 1], [0, 1]], (6, 1))
    return TriMesh(
        np.array(vertices, dtype=np.float32), faces.astype(np.int32), np.array(normals, dtype=np.float32),
        uv=uv.astype(np.float32),
    )  # fmt: skip


def _turned(rim: Array, z: Array, out: Array, up: Array, t: Array) -> TriMesh:
    """Return a surface of revolution about z with normals and vertical texture coordinates."""
    turn = np.linspace(-np.pi, np.pi, AROUND + 1)
    cos, sin, count = np.cos(turn), np.sin(turn), len(rim)

    def around(radial: Array, axial: Array) -> NDArray[np.float32]:
        rows = [radial[:, None] * cos, radial[:, None] * sin, np.repeat(axial[:, None], len(turn), 1)]
        return np.stack(rows, -1).reshape(-1, 3).astype(np.float32)

    s = np.tile(np.linspace(0.0, 1.0, AROUND + 1), count)
    row, column = (each.ravel() for each in np.mgrid[: count - 1, :AROUND])
    a = row * (AROUND + 1) + column
    b, c, d = a + 1, a + AROUND + 2, a + AROUND + 1
    vertices = around(rim, z)
    faces = np.concatenate([np.stack([a, b, c], -1), np.stack([a, c, d], -1)])
    first, second = (vertices[faces[:, k]] - vertices[faces[:, 0]] for k in (1, 2))
    faces = faces[np.linalg.norm(np.cross(first, second), axis=1) > 1e-12]
    uv = np.column_stack([s, np.repeat(t, AROUND + 1)]).astype(np.float32)
    return TriMesh(vertices, faces.astype(np.int32), around(out, up), uv=uv)
