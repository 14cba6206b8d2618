"""Conversion of the links of a world to shapes of the scene table."""

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.sdf import WorldLink, WorldShape
from urdfkit.description.sdf.shapes import plugins_of
from urdfkit.description.urdf.robot import Mesh
from urdfkit.errors import ResourceError
from urdfkit.linear_algebra import matmul
from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.specular import GLOSSY, MATT, Gloss, gloss_of
from urdfkit.scene.colors import DEFAULT, GAZEBO, Rgba
from urdfkit.scene.pose_matrices import pose_matrix
from urdfkit.scene.scene_table import Role, Shape
from urdfkit.scene.segmentation_labels import label_of


def shapes_of_link(
    link: WorldLink,
    body: str,
    placement: NDArray[np.float64],
    *,
    meshes: MeshLoader,
    prefix: str = "",
    label: int = 0,
    note: Callable[[str], None] | None = None,
) -> Iterator[Shape]:
    """Yield the visuals and collisions of a link.

    Visuals with a missing mesh are omitted; the reader of the world has reported them.

    Args:
        link: as written.
        body: the body of the link.
        placement: placement of the link in that body; shape (4, 4).
        meshes: loader of the mesh files.
        prefix: prefix of the names of the shapes if a body has several links.
        label: label of the model, for visuals without their own.
        note: receives messages about visuals with an invalid mesh, which are omitted.

    Raises:
        ResourceError: a mesh is invalid.
    """
    for role, shape in _items(link):
        mesh = None
        if isinstance(shape.geometry, Mesh):
            if not shape.file:
                continue
            try:
                mesh = meshes.load(Path(shape.file), shape.geometry.scale)
            except ResourceError as error:
                if note is None or role == "collision":
                    raise
                note(f"{shape.position or body}: visual `{shape.name}` is invisible: {error}")
                continue
        rgba = color_of(shape) if role == "visual" else None
        placed = matmul(placement, pose_matrix(shape.pose))
        placed.flags.writeable = False
        name = f"{body}/{role}/{prefix}{shape.name}"
        shown = rgba or (*DEFAULT[:3], 1.0 - shape.transparency)
        called = label_of(plugins_of(shape.kept)) or label
        yield Shape(
            name, body, role, shape.geometry, placed, shown, rgba is not None, mesh, shape.laser_retro, called,
            gloss_on(shape) if role == "visual" else MATT, shape.position,
        )  # fmt: skip


def color_of(shape: WorldShape) -> Rgba | None:
    """Return the colour of a visual, components in 0..1; None if none is defined."""
    rgba = shape.rgba or GAZEBO.get(shape.material.removeprefix("Gazebo/"))
    return None if rgba is None else (*rgba[:3], rgba[3] * (1.0 - shape.transparency))


def gloss_on(shape: WorldShape) -> Gloss:
    """Return the specular properties of a visual."""
    material = next((kept.element for kept in shape.kept if kept.element.tag == "material"), None)
    found = gloss_of(material) if material is not None else GLOSSY.get(shape.material.removeprefix("Gazebo/"))
    return found or MATT


def _items(link: WorldLink) -> Iterator[tuple[Role, WorldShape]]:
    for shape in link.visuals:
        yield "visual", shape
    for shape in link.collisions:
        yield "collision", shape
