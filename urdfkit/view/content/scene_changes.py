"""Adding shapes to the shown scene and removing bodies, without drawing the rest again."""

from collections.abc import Iterable, Sequence
from typing import Any

from urdfkit.scene import Shape
from urdfkit.view.content.mesh_store import GeometryStore
from urdfkit.view.content.meshcat_objects import SharedGeometry, draw_shapes, geometry_of, link_path


def draw_more(
    shapes: Sequence[Shape], window: Any, geometries: GeometryStore, *, instead_of: Sequence[str] = ()
) -> None:
    """Add shapes to the shown scene.

    Args:
        shapes: the added shapes.
        window: receives meshcat commands by ``send``.
        geometries: receives the meshes; none is removed, see `forget_others`.
        instead_of: bodies whose shapes are removed first.
    """
    import meshcat  # after `meshcat_objects`, which suppresses its warnings

    root = meshcat.Visualizer.view_into(window, meshcat.path.Path())
    for body in instead_of:
        root[link_path(body).lstrip("/")].delete()
    draw_shapes(shapes, root, geometries)


def forget_others(shapes: Iterable[Shape], geometries: GeometryStore) -> None:
    """Remove all meshes except those of these shapes."""
    used = (geometry_of(shape, geometries)[0] for shape in shapes)
    geometries.keep_only({geometry.name for geometry in used if isinstance(geometry, SharedGeometry)})
