"""Geometries with their colours and textures as ``trimesh.Trimesh``."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from urdfkit.description.sdf import Cone, Ellipsoid, Plane
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Sphere
from urdfkit.errors import MissingDependencyError
from urdfkit.meshes.triangle_mesh import TriMesh
from urdfkit.scene.pose_matrices import upright

try:
    import trimesh
except ImportError as error:
    raise MissingDependencyError("to_trimesh needs trimesh: pip install 'urdfkit[view]'") from error


def empty_scene(base: str) -> Any:
    """Return a ``trimesh.Scene`` without shapes; `base` is the name of its root."""
    return trimesh.Scene(base_frame=base)


def meshes_of(
    geometry: Geometry | Plane | Ellipsoid | Cone,
    mesh: TriMesh | None,
    rgba: tuple[float, float, float, float],
    *,
    has_color: bool,
) -> list[Any]:
    """Return the triangles of a shape, one mesh for each of its textures.

    Args:
        geometry: the shape.
        mesh: its triangles, if it is a mesh.
        rgba: its colour, 0..1.
        has_color: whether the colour replaces those of the mesh.
    """
    color = np.rint(255.0 * np.array(rgba)).astype(np.uint8)
    if mesh is None:
        solid = _solid(geometry)
        solid.visual.face_colors = color
        return [solid]
    return list(_parts(mesh, color, has_color))


def _parts(mesh: TriMesh, color: Any, has_color: bool) -> Iterator[Any]:
    """Yield the triangles without texture, then those of each texture."""
    textures = mesh.face_textures if mesh.uv is not None and not has_color else None
    for k in [-1] if textures is None else np.unique(textures).tolist():
        faces = mesh.faces if textures is None else mesh.faces[textures == k]
        part = trimesh.Trimesh(mesh.vertices, faces, vertex_normals=mesh.normals, process=False)
        if k >= 0:
            from PIL import Image

            image = Image.fromarray(mesh.textures[k].pixels)
            material = trimesh.visual.material.PBRMaterial(baseColorTexture=image)
            part.visual = trimesh.visual.TextureVisuals(uv=mesh.uv, material=material)
        elif mesh.colors is not None and not has_color:
            part.visual.vertex_colors = mesh.colors
        else:
            part.visual.face_colors = color
        yield part


def _solid(geometry: Geometry | Plane | Ellipsoid | Cone) -> Any:
    create = trimesh.creation
    if isinstance(geometry, Box):
        return create.box(geometry.size)
    if isinstance(geometry, Sphere):
        return create.icosphere(radius=geometry.radius)
    if isinstance(geometry, Cylinder):
        return create.cylinder(geometry.radius, geometry.length)
    if isinstance(geometry, Capsule):
        return create.capsule(geometry.length, geometry.radius)
    if isinstance(geometry, Ellipsoid):
        return create.icosphere().apply_scale(geometry.radii)
    if isinstance(geometry, Cone):
        return create.cone(geometry.radius, geometry.length).apply_translation([0.0, 0.0, -geometry.length / 2.0])
    assert isinstance(geometry, Plane)
    half = np.array([*geometry.size, 0.0]) / 2.0
    corners = half * [[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]
    return trimesh.Trimesh(corners @ upright(geometry.normal).T, [[0, 1, 2], [0, 2, 3]], process=False)
