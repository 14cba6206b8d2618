"""Appearance of one part of a mesh file read by trimesh: normals, colours, specular properties, textures."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import matmul
from urdfkit.meshes.material_colors import factor_of, obj_opacity, srgb_bytes
from urdfkit.meshes.specular import MATT, Gloss, gloss_from
from urdfkit.meshes.textures import Texture, texture_of


def normals_in(part: Any, linear: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the vertex normals of the file, transformed with the part; None without any."""
    if "vertex_normals" not in part._cache.cache:
        return None
    written = np.asarray(part.vertex_normals, dtype=float)
    if written.shape != part.vertices.shape or np.linalg.det(linear) == 0:
        return None
    # Normals are transformed by the inverse transpose, which is proportional to the matrix of cofactors.
    cofactors = np.stack(
        [np.cross(linear[1], linear[2]), np.cross(linear[2], linear[0]), np.cross(linear[0], linear[1])]
    )
    turned = matmul(written, cofactors.T) * np.sign(np.linalg.det(linear))
    length = np.linalg.norm(turned, axis=1, keepdims=True)
    unit: NDArray[np.float64] = np.divide(turned, length, out=np.zeros_like(turned), where=length > 0)
    return unit


def colors_in(part: Any, *, linear: bool) -> NDArray[np.uint8] | None:
    """Return the colours per vertex of the file; for a material, its colour. None for a part without material.

    Args:
        part: a part of the file.
        linear: whether colours are linear, as those of glTF; otherwise they are sRGB.
    """
    visual = part.visual
    if visual.kind == "vertex":
        written = np.asarray(visual.vertex_colors, dtype=np.uint8)
        return srgb_bytes(written / 255.0) if linear else written
    if visual.kind == "texture" and not _is_default(visual.material):
        return np.tile(_color_of(visual.material, linear=linear), (len(part.vertices), 1))
    return None


def _is_default(material: Any) -> bool:
    """Return whether trimesh made a material, of one colour, for texture coordinates of an OBJ file without one."""
    if getattr(material, "kwargs", True):
        return False
    image = getattr(material, "image", None)
    return image is None or image.format is None  # images of files have a format


def _color_of(material: Any, *, linear: bool) -> NDArray[np.uint8]:
    """Return the colour and opacity of a material."""
    color: NDArray[np.uint8] = np.array(material.main_color, dtype=np.uint8)
    if linear and (factor := factor_of(material)) is not None:
        color = srgb_bytes(factor)
    if (written := getattr(material, "kwargs", None)) is not None:
        color[3] = round(255 * obj_opacity(written))
    elif getattr(material, "alphaMode", None) == "OPAQUE" or (linear and not getattr(material, "alphaMode", None)):
        color[3] = 255
    return color


def gloss_in(part: Any) -> Gloss:
    """Return the specular properties of the material of a part: ``Ks`` and ``Ns`` of an OBJ file."""
    written = getattr(getattr(part.visual, "material", None), "kwargs", None) or {}
    return gloss_from(written.get("ks"), written.get("ns")) or MATT


def places_in(part: Any) -> NDArray[np.float64] | None:
    """Return the texture coordinates of the vertices of a part; None without any."""
    if part.visual.kind != "texture" or part.visual.uv is None or len(part.visual.uv) != len(part.vertices):
        return None
    found = np.asarray(part.visual.uv, dtype=float)
    return found if np.isfinite(found).all() else None


def texture_in(part: Any, *, linear: bool) -> Texture | None:
    """Return the texture of a part, if it has one and texture coordinates; `linear` as for `colors_in`."""
    if places_in(part) is None or _is_default(part.visual.material):
        return None
    try:
        return texture_of(part.visual.material, linear=linear)
    except (OSError, ValueError, SyntaxError):  # raised by Pillow for invalid images
        return None
