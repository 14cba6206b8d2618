"""Triangles of shapes for OpenGL: round solids as facets, meshes unchanged."""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array
from urdfkit.meshes.specular import MATT, Gloss
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.rays import primitives
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.surface_attributes import COLORED, COLORS, GLOSS, OPACITY, SMOOTH, TEXTURE, UV

AROUND = 64
"""Facets around a cylinder or a sphere."""

SWELL = 2.0 / (1.0 + np.cos(np.pi / AROUND))
"""Factor of the radius of facets: their edges are as far outside of the surface as their centres are inside."""

VERTEX = 12
"""Numbers per vertex: position, normal, texture coordinates, colour and opacity."""


@dataclass(frozen=True, eq=False)
class TriangleModel:
    """Triangles that are drawn with one call for all shapes that use them.

    Attributes:
        vertices: three consecutive vertices per triangle, counter-clockwise from outside; shape (n, `VERTEX`), float32.
        shapes: indices of the shapes in the table.
        scale: scale of the model in each shape; shape (shapes, 3).
        texture: index of the texture, -1 for none.
        flat: whether the normals are those of the triangles.
        casts: whether it casts shadows; planes do not.
        closed: whether the surface is closed, so that its back faces are never visible from outside.
        gloss: specular colour and exponent; zero means matt.
    """

    vertices: NDArray[np.float32]
    shapes: NDArray[np.int64]
    scale: NDArray[np.float32]
    texture: int
    flat: bool
    casts: bool = True
    closed: bool = False
    gloss: Gloss = MATT

    @cached_property
    def plain(self) -> bool:
        """Whether its triangles have one colour each."""
        colors = self.vertices[:, 8:].reshape(-1, 3, 4)
        return bool((colors == colors[:, :1]).all())


def models_of(table: RayTable, paint: tuple[Any, ...]) -> list[TriangleModel]:
    """Return the models of a table.

    Args:
        table: the shapes.
        paint: materials of the shapes, see `paint_of`.
    """
    kinds, local = table.kernel_scene[1], table.sizes
    groups: dict[Any, list[int]] = {}
    for k, kind in enumerate(kinds.tolist()):
        key: Any = kind
        if kind == primitives.MESH:
            mesh = table.shapes[k].mesh
            key = (kind, mesh.hash if mesh is not None else "", int(paint[1][k]))
        elif kind == primitives.CAPSULE:
            key = (kind, *local[k, :2].tolist())
        groups.setdefault((key, table.shapes[k].gloss), []).append(k)
    found: list[TriangleModel] = []
    for (key, gloss), members in groups.items():
        shapes = np.array(members)
        if isinstance(key, tuple) and key[0] == primitives.MESH:
            first, faces = table.triangles_of(members[0])
            attributes = paint[3][first : first + len(faces)]
            found += _of_mesh(table.shapes[members[0]].mesh, key[2], attributes, faces, shapes, gloss)
            continue
        points, normals, flat = _solid(key)
        vertices = np.zeros((len(points), VERTEX), dtype=np.float32)
        vertices[:, :3], vertices[:, 3:6], vertices[:, 8:] = points, normals, 1.0
        scale = _scales(key, local[shapes]).astype(np.float32)
        found.append(TriangleModel(vertices, shapes, scale, -1, flat, key != primitives.PLANE, gloss=gloss))
    return found


def triangles_of(table: RayTable, shape: int) -> Array:
    """Return the triangles of one shape in its own frame [m]; shape (n, 3, 3)."""
    mesh = table.shapes[shape].mesh
    kind, size = int(table.kernel_scene[1][shape]), table.sizes[shape]
    if mesh is not None and kind == primitives.MESH:
        return mesh.vertices[mesh.faces].astype(float)
    key: Any = (kind, *size[:2].tolist()) if kind == primitives.CAPSULE else kind
    found: Array = (_solid(key)[0] * _scales(key, size[None])[0]).reshape(-1, 3, 3)
    return found


def _scales(key: Any, sizes: Array) -> Array:
    if isinstance(key, tuple):
        return np.ones_like(sizes)
    if key == primitives.SPHERE:
        return np.repeat(sizes[:, :1], 3, axis=1)
    if key in (primitives.CYLINDER, primitives.CONE):
        return sizes[:, [0, 0, 1]]
    return np.column_stack([sizes[:, :2], np.ones(len(sizes))]) if key == primitives.PLANE else sizes


def _of_mesh(
    mesh: TriMesh | None, features: int, attributes: Any, faces: Any, shapes: NDArray[np.int64], gloss: Gloss
) -> list[TriangleModel]:
    """Return the models of a mesh, one per texture and gloss.

    Args:
        mesh: the triangles.
        features: flags of the used attributes.
        attributes: attributes of the triangles, in the order of the trees.
        faces: indices of these triangles in the mesh.
        shapes: indices in the table.
        gloss: specular properties of the shapes, unless those of the mesh are used.
    """
    assert mesh is not None
    corners = mesh.vertices[mesh.faces[faces]].astype(float)
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.repeat(across[:, None], 3, axis=1)
    if features & SMOOTH:
        normals = attributes[:, :COLORS].reshape(-1, 3, 3).astype(float)
        normals = normals * np.where((normals * across[:, None]).sum(-1, keepdims=True) < 0.0, -1.0, 1.0)
    vertices = np.zeros((len(faces), 3, VERTEX), dtype=np.float32)
    length = np.linalg.norm(normals, axis=-1, keepdims=True)
    vertices[..., :3], vertices[..., 3:6] = corners, normals / np.where(length > 0.0, length, 1.0)
    vertices[..., 8:] = 1.0
    kinds = np.tile(np.array([-1.0, *gloss], dtype=np.float32), (len(faces), 1))
    if features & COLORED:
        kinds = np.column_stack([attributes[:, TEXTURE], attributes[:, GLOSS:]])
        vertices[..., 6:8] = attributes[:, UV:TEXTURE].reshape(-1, 3, 2)
        vertices[..., 8:11] = np.where(kinds[:, :1, None] >= 0, 1.0, attributes[:, COLORS:UV].reshape(-1, 3, 3))
        vertices[..., 11] = attributes[:, OPACITY][:, None]
    ones = np.ones((len(shapes), 3), dtype=np.float32)
    distinct, which = np.unique(kinds, axis=0, return_inverse=True)
    found = []
    for k, (texture, red, green, blue, exponent) in enumerate(distinct.tolist()):
        chosen, own = vertices[which.ravel() == k].reshape(-1, VERTEX), (red, green, blue, exponent)
        found.append(TriangleModel(chosen, shapes, ones, int(texture), not features & SMOOTH, gloss=own))
    return found


def _solid(key: Any) -> tuple[Array, Array, bool]:
    """Return vertices and normals of a solid of size 1, three per triangle, and whether it is flat."""
    turn = np.linspace(0.0, 2.0 * np.pi, AROUND + 1)
    if key == primitives.BOX:
        square = np.array([[-1, -1], [1, -1], [1, 1], [-1, -1], [1, 1], [-1, 1]], dtype=float)
        faces, normals = [], []
        for axis in range(3):
            for side in (1.0, -1.0):
                face = np.empty((6, 3))
                face[:, axis], face[:, (axis + 1) % 3], face[:, (axis + 2) % 3] = (
                    side,
                    square[:, 0],
                    side * square[:, 1],
                )
                faces.append(face)
                normals.append(np.tile(np.eye(3)[axis] * side, (6, 1)))
        return np.vstack(faces), np.vstack(normals), True
    if key == primitives.PLANE:
        square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
        return square, np.tile([0.0, 0.0, 1.0], (6, 1)), True
    if key in (primitives.SPHERE, primitives.ELLIPSOID):
        height = np.linspace(-np.pi / 2, np.pi / 2, AROUND // 2 + 1)
        rim, z = np.cos(height), np.sin(height)
        return *_turned(SWELL * rim, SWELL * z, rim, z, turn), False
    if key == primitives.CYLINDER:
        rim = np.array([0.0, 1.0, 1.0, 1.0, 1.0, 0.0])
        z = np.array([-1.0, -1.0, -1.0, 1.0, 1.0, 1.0])
        return *_turned(rim, z, np.array([0, 0, 1.0, 1, 0, 0]), np.array([-1.0, -1, 0, 0, 1, 1]), turn), False
    if key == primitives.CONE:
        # The normal of the side in the frame of size 1, with the apex at +1 and the rim at -1.
        rim, z = np.array([0.0, 1.0, 1.0, 0.0]), np.array([-1.0, -1.0, -1.0, 1.0])
        return *_turned(rim, z, np.array([0, 0, 1.0, 1.0]), np.array([-1.0, -1, 0.5, 0.5]), turn), False
    _, radius, half = key
    angle = np.linspace(-np.pi / 2, np.pi / 2, AROUND // 2 + 2)
    angle = np.sort(np.append(angle, 0.0))
    lift = np.where(np.arange(len(angle)) < len(angle) // 2, -half, half)
    rim, z = radius * np.cos(angle), radius * np.sin(angle) + lift
    return *_turned(rim, z, np.cos(angle), np.sin(angle), turn), False


def _turned(rim: Array, z: Array, out: Array, up: Array, turn: Array) -> tuple[Array, Array]:
    """Return the triangles and normals of a surface of revolution about z."""
    rim = SWELL * rim

    def around(radial: Array, axial: Array) -> Array:
        return np.stack(
            [radial[:, None] * np.cos(turn), radial[:, None] * np.sin(turn), np.repeat(axial[:, None], len(turn), 1)],
            -1,
        )

    def triangles(grid: Array) -> Array:
        a, b, c, d = grid[:-1, :-1], grid[:-1, 1:], grid[1:, 1:], grid[1:, :-1]
        return np.stack([a, b, c, a, c, d], axis=2).reshape(-1, 3, 3)

    points, normals = triangles(around(rim, z)), triangles(around(out, up))
    area = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1)
    kept = area > 1e-12
    return points[kept].reshape(-1, 3), normals[kept].reshape(-1, 3)
