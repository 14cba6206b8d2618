"""Colours, textures and specular properties of the shapes of a table, as arrays for the kernels."""

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.meshes.textures import Texture
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.surface_attributes import (
    ATTRIBUTES,
    COLORED,
    COLORS,
    GLOSS,
    OPACITY,
    SMOOTH,
    TEXTURE,
    UV,
)

NOTHING = -1
"""Kind of a shape that rays ignore."""


def paint_of(table: RayTable) -> tuple[Any, ...]:
    """Return the argument `paint` of `camera_picture.trace`."""
    colors, features = np.ones((len(table.shapes), 4)), np.zeros(len(table.shapes), dtype=np.int64)
    glosses = np.zeros((len(table.shapes), 4))
    for k, shape in enumerate(table.shapes):
        own = shape.mesh is not None and not shape.has_color and shape.mesh.has_own_colors
        colors[k] = (1.0, 1.0, 1.0, shape.rgba[3]) if own else shape.rgba
        smooth = shape.mesh is not None and shape.mesh.normals is not None
        features[k] = SMOOTH * smooth + COLORED * own
        glosses[k] = shape.gloss
    textures_by_hash: dict[str, tuple[int, Texture]] = {}
    attributes = np.zeros((table.triangle_count if features.any() else 1, ATTRIBUTES), dtype=np.float32)
    for first, faces, mesh in table.meshes if features.any() else ():
        attributes[first : first + len(faces)] = attributes_of(mesh, textures_by_hash)[faces]
    texels = [
        np.concatenate([level.ravel() for level in mip_levels(texture.pixels)])
        for _, texture in textures_by_hash.values()
    ]
    starts = np.cumsum([0, *map(len, texels)])
    textures = np.array(
        [
            (start, *texture.pixels.shape[1::-1])
            for start, (_, texture) in zip(starts, textures_by_hash.values(), strict=False)
        ],
        dtype=np.int64,
    ).reshape(-1, 3)
    return (
        colors,
        features,
        glosses,
        attributes,
        textures,
        np.concatenate(texels) if texels else np.zeros(4, dtype=np.uint8),
    )


def mip_levels(pixels: NDArray[np.uint8]) -> Iterator[NDArray[np.uint8]]:
    """Yield a texture and its mip levels, halved down to one texel; an odd last row or column is dropped."""
    yield pixels
    exact: NDArray[Any] = pixels.astype(np.float32)
    while max(exact.shape[:2]) > 1:
        for axis in (0, 1):
            if (half := exact.shape[axis] // 2) > 0:
                even, odd = (exact.take(np.arange(half) * 2 + k, axis=axis) for k in (0, 1))
                exact = (even + odd) / 2
        yield np.rint(exact).astype(np.uint8)


def attributes_of(mesh: TriMesh, textures_by_hash: dict[str, tuple[int, Texture]]) -> NDArray[np.float32]:
    """Return the attributes of a mesh's triangles, shape (triangles, `ATTRIBUTES`); add its textures to the table."""
    faces = mesh.faces
    attributes = np.zeros((len(faces), ATTRIBUTES), dtype=np.float32)
    attributes[:, COLORS:UV], attributes[:, TEXTURE], attributes[:, OPACITY] = 1.0, -1.0, 1.0
    if mesh.normals is not None:
        attributes[:, :COLORS] = mesh.normals[faces].reshape(-1, 9)
    if mesh.face_gloss is not None:
        attributes[:, GLOSS:] = mesh.face_gloss
    if mesh.colors is not None:
        attributes[:, COLORS:UV] = mesh.colors[:, :3][faces].reshape(-1, 9) / 255.0
        attributes[:, OPACITY] = mesh.colors[:, 3][faces].mean(axis=1) / 255.0
    if mesh.uv is not None and mesh.face_textures is not None:
        attributes[:, UV:TEXTURE] = mesh.uv[faces].reshape(-1, 6)
        numbers = [
            textures_by_hash.setdefault(texture.hash, (len(textures_by_hash), texture))[0] for texture in mesh.textures
        ]
        wrapped = mesh.face_textures >= 0
        attributes[wrapped, TEXTURE] = np.array(numbers)[mesh.face_textures[wrapped]]
        attributes[wrapped, OPACITY] = 1.0
    return attributes


def occluders_of(table: RayTable) -> tuple[Any, ...]:
    """Return the scene of the shapes that cast shadows: all opaque ones."""
    clear = np.array([shape.rgba[3] < 1.0 for shape in table.shapes], dtype=bool)
    world, kinds, *rest = table.kernel_scene
    return (world, np.where(clear, NOTHING, kinds), *rest) if clear.any() else table.kernel_scene
