"""Mesh files: where they are, and the box around one. trimesh is loaded only for a mesh that is there."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from urdfkit.description.element import Element
    from urdfkit.description.robot import Link, Mesh, Vector
    from urdfkit.lint.model import Model

LFS = b"version https://git-lfs.github.com/spec/"
"""How a Git LFS pointer begins."""


def meshes(model: Model) -> Iterator[tuple[Mesh, Element, Link]]:
    """Yield every mesh with its ``<mesh>`` element and link."""
    from urdfkit.description.robot import Mesh
    from urdfkit.lint.placement import shapes_of

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
        from urdfkit.scene.mesh import MeshLoader

        low, high = MeshLoader().load(path, mesh.scale).bounds.tolist()
    except (UrdfkitError, ImportError):
        return None
    centre = [(a + b) / 2.0 for a, b in zip(low, high, strict=True)]
    size = [b - a for a, b in zip(low, high, strict=True)]
    return (centre[0], centre[1], centre[2]), (size[0], size[1], size[2])
