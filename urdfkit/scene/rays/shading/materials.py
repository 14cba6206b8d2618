"""What the shapes of a table look like, as the kernels take it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.scene.meshes.loader import TriMesh
from urdfkit.scene.meshes.textures import Texture
from urdfkit.scene.rays.ray_scene import RayTable
from urdfkit.scene.rays.shading.surface_attributes import GLOSS, HUE, OPACITY, OWN, SKIN, SMOOTH, TEXTURE, UV

NOTHING = -1
"""Kind of a shape that rays go through."""


def paint_of(table: RayTable) -> tuple[Any, ...]:
    """Return colours of the shapes, what they take from skins, gloss, skins of the triangles, textures and texels."""
    colors, worn = np.ones((len(table.shapes), 4)), np.zeros(len(table.shapes), dtype=np.int64)
    glosses = np.zeros((len(table.shapes), 4))
    for k, shape in enumerate(table.shapes):
        own = shape.mesh is not None and not shape.has_color and wears(shape.mesh)
        colors[k] = (1.0, 1.0, 1.0, shape.rgba[3]) if own else shape.rgba
        smooth = shape.mesh is not None and shape.mesh.normals is not None
        worn[k] = SMOOTH * smooth + OWN * own
        glosses[k] = shape.gloss
    known: dict[str, tuple[int, Texture]] = {}
    skins = np.zeros((table.triangle_count if worn.any() else 1, SKIN), dtype=np.float32)
    for first, faces, mesh in table.meshes if worn.any() else ():
        skins[first : first + len(faces)] = skins_of(mesh, known)[faces]
    texels = [np.concatenate([level.ravel() for level in copies(texture.pixels)]) for _, texture in known.values()]
    starts = np.cumsum([0, *map(len, texels)])
    textures = np.array(
        [(start, *texture.pixels.shape[1::-1]) for start, (_, texture) in zip(starts, known.values(), strict=False)],
        dtype=np.int64,
    ).reshape(-1, 3)
    return colors, worn, glosses, skins, textures, np.concatenate(texels) if texels else np.zeros(4, dtype=np.uint8)


def copies(pixels: NDArray[np.uint8]) -> Iterator[NDArray[np.uint8]]:
    """Yield a texture and its smaller copies, halved until one texel is left; an odd last row or column is dropped."""
    yield pixels
    exact: NDArray[Any] = pixels.astype(np.float32)
    while max(exact.shape[:2]) > 1:
        for axis in (0, 1):
            if (half := exact.shape[axis] // 2) > 0:
                even, odd = (exact.take(np.arange(half) * 2 + k, axis=axis) for k in (0, 1))
                exact = (even + odd) / 2
        yield np.rint(exact).astype(np.uint8)


def wears(mesh: TriMesh) -> bool:
    """Whether a mesh brings colours or textures of its own."""
    return mesh.colors is not None or bool(mesh.textures)


def skins_of(mesh: TriMesh, known: dict[str, tuple[int, Texture]]) -> NDArray[np.float32]:
    """Return the skins of a mesh's triangles, and count its textures among the known; shape (triangles, `SKIN`)."""
    faces = mesh.faces
    skins = np.zeros((len(faces), SKIN), dtype=np.float32)
    skins[:, HUE:UV], skins[:, TEXTURE], skins[:, OPACITY] = 1.0, -1.0, 1.0
    if mesh.normals is not None:
        skins[:, :HUE] = mesh.normals[faces].reshape(-1, 9)
    if mesh.face_gloss is not None:
        skins[:, GLOSS:] = mesh.face_gloss
    if mesh.colors is not None:
        skins[:, HUE:UV] = mesh.colors[:, :3][faces].reshape(-1, 9) / 255.0
        skins[:, OPACITY] = mesh.colors[:, 3][faces].mean(axis=1) / 255.0
    if mesh.uv is not None and mesh.face_textures is not None:
        skins[:, UV:TEXTURE] = mesh.uv[faces].reshape(-1, 6)
        numbers = [known.setdefault(texture.hash, (len(known), texture))[0] for texture in mesh.textures]
        wrapped = mesh.face_textures >= 0
        skins[wrapped, TEXTURE] = np.array(numbers)[mesh.face_textures[wrapped]]
        skins[wrapped, OPACITY] = 1.0
    return skins


def cover_of(table: RayTable) -> tuple[Any, ...]:
    """Return what stands between lights and surfaces, as the kernels take it: everything opaque."""
    clear = np.array([shape.rgba[3] < 1.0 for shape in table.shapes], dtype=bool)
    world, kinds, *rest = table.kernel_scene
    return (world, np.where(clear, NOTHING, kinds), *rest) if clear.any() else table.kernel_scene
