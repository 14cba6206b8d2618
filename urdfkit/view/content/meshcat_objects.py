"""Scene → meshcat objects at ``/robot/links/<link>/{visual,collision}/<n>``, all of them or a part."""

import warnings
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere, Vector
from urdfkit.errors import MissingDependencyError
from urdfkit.scene import Scene, Shape, TriMesh
from urdfkit.view.content.mesh_store import GeometryStore

try:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # meshcat 0.3.2 imports zmq.eventloop.ioloop
        import meshcat
        import meshcat.geometry
except ImportError as error:  # pragma: no cover
    raise MissingDependencyError("view needs meshcat: pip install 'urdfkit[view]'") from error

LINKS = "/robot/links"
COLLISION_RGBA = (0.95, 0.55, 0.10, 0.45)
"""Colour of collision geometry."""
CAPSULE_SEGMENTS = 24
MATT_ROUGHNESS = 0.65
"""Roughness of surfaces for which the description defines no specular properties: that of painted plastic."""

# The axis of a cylinder is y in meshcat and z in URDF.
Y_TO_Z = np.array([[1.0, 0, 0, 0], [0, 0, -1.0, 0], [0, 1.0, 0, 0], [0, 0, 0, 1.0]])


class SharedGeometry(meshcat.geometry.Geometry):  # type: ignore[misc]
    """A mesh that the browser fetches once by its content hash, for all shapes that use it."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.name = name

    def lower(self, object_data: dict[str, Any]) -> dict[str, Any]:
        """Return the message for the browser."""
        return {"uuid": self.uuid, "type": "_shared", "name": self.name}


class PlaceholderGeometry(meshcat.geometry.Geometry):  # type: ignore[misc]
    """A hatched box in place of a shape that cannot be shown.

    Args:
        size: its edges [m].
        opacity: 0..1.
    """

    def __init__(self, size: Vector, opacity: float) -> None:
        super().__init__()
        self.size, self.opacity = size, opacity

    def lower(self, object_data: dict[str, Any]) -> dict[str, Any]:
        """Return the message for the browser."""
        return {"uuid": self.uuid, "type": "_placeholder", "size": list(self.size), "opacity": self.opacity}


def link_path(link: str) -> str:
    """Return the scene path of a link. meshcat splits paths at slashes, so slashes in names are escaped as ``%2F``."""
    return f"{LINKS}/{link.replace('%', '%25').replace('/', '%2F')}"


def draw(scene: Scene, window: Any, geometries: GeometryStore) -> None:
    """Send the shapes of a scene, replacing the previous scene.

    Args:
        scene: bodies and shapes.
        window: receives meshcat commands by ``send``.
        geometries: receives the meshes; meshes of the previous scene are removed.
    """
    root = meshcat.Visualizer.view_into(window, meshcat.path.Path())
    root["robot"].delete()
    geometries.keep_only(draw_shapes(scene.shapes, root, geometries))


def draw_shapes(shapes: Iterable[Shape], root: Any, geometries: GeometryStore) -> set[str]:
    """Send shapes, below their links.

    Args:
        shapes: the shapes to add to the scene.
        root: meshcat's visualizer.
        geometries: receives the meshes.

    Returns:
        The names of the meshes.
    """
    used = set()
    counts: dict[str, int] = {}
    for shape in shapes:
        where = f"{link_path(shape.body)}/{shape.role}"
        number = counts[where] = counts.get(where, -1) + 1
        geometry, inner = geometry_of(shape, geometries)
        if geometry is None:
            continue
        if isinstance(geometry, SharedGeometry):
            used.add(geometry.name)
        node = root[f"{where.lstrip('/')}/{number}"]
        node.set_object(geometry, material(shape))
        node.set_transform(np.asarray(shape.placement, dtype=float) @ inner)
    return used


def geometry_of(shape: Shape, geometries: GeometryStore) -> tuple[Any, NDArray[np.float64]]:
    """Return a shape's meshcat geometry, None if it has none, and its placement in the shape's frame."""
    geometry = shape.geometry
    if shape.mesh is not None:
        return SharedGeometry(geometries.add(shape.mesh)), np.eye(4)
    if isinstance(geometry, Box):
        if shape.is_placeholder:
            return PlaceholderGeometry(geometry.size, shape.rgba[3]), np.eye(4)
        return meshcat.geometry.Box([float(edge) for edge in geometry.size]), np.eye(4)
    if isinstance(geometry, Sphere):
        return meshcat.geometry.Sphere(float(geometry.radius)), np.eye(4)
    if isinstance(geometry, Cylinder):
        return meshcat.geometry.Cylinder(float(geometry.length), float(geometry.radius)), Y_TO_Z
    if isinstance(geometry, Capsule):
        return SharedGeometry(geometries.add(capsule(geometry.radius, geometry.length))), np.eye(4)
    return None, np.eye(4)


class SurfaceMaterial(meshcat.geometry.GenericMaterial):  # type: ignore[misc]
    """The material of a shape, see `appearance/surfaces.js`."""

    _type = "MeshStandardMaterial"


def material(shape: Shape) -> Any:
    """Return the material of a shape."""
    own = shape.role == "visual" and shape.mesh is not None and shape.mesh.has_own_colors and not shape.has_color
    rgba = COLLISION_RGBA if shape.role == "collision" else (1.0, 1.0, 1.0, shape.rgba[3]) if own else shape.rgba
    red, green, blue = (round(255 * min(1.0, max(0.0, float(c)))) for c in rgba[:3])
    opacity = min(1.0, max(0.0, float(rgba[3])))
    return SurfaceMaterial(
        color=(red << 16) | (green << 8) | blue,
        opacity=opacity,
        transparent=opacity < 1.0,
        vertexColors=own and shape.mesh is not None and shape.mesh.colors is not None,
        roughness=roughness(shape),
        metalness=0.0,
        userData={} if own else {"gloss": [float(number) for number in shape.gloss]},
    )


def roughness(shape: Shape) -> float:
    """Return the roughness, 0..1, that has highlights as wide as those of the specular exponent of a shape.

    Source: Walter et al., *Microfacet Models for Refraction through Rough Surfaces* (2007): exponent = 2 / alpha^2 - 2,
    where alpha is the square of the roughness.
    """
    exponent = shape.gloss[3]
    return float((2.0 / (exponent + 2.0)) ** 0.25) if exponent > 0.0 else MATT_ROUGHNESS


def capsule(radius: float, length: float) -> TriMesh:
    """Return a capsule along z; `length` is the length of its cylindrical part [m]."""
    n, rings = CAPSULE_SEGMENTS, CAPSULE_SEGMENTS // 4
    quarter = np.linspace(0, np.pi / 2, rings + 1)
    polar = np.concatenate([quarter, np.pi - quarter[::-1]])
    out = np.sin(polar) * (np.abs(np.cos(polar)) < 1)  # exactly zero at the poles
    lift = np.repeat([length / 2, -length / 2], rings + 1) + radius * np.cos(polar)
    turn = np.arange(n) * 2 * np.pi / n
    ring = np.stack([np.cos(turn), np.sin(turn), np.zeros(n)], axis=1)
    vertices = np.concatenate([radius * o * ring + [0, 0, z] for o, z in zip(out, lift, strict=True)])
    last = len(polar) - 2
    faces = []
    for row in range(last + 1):
        if row == rings and length == 0:
            continue
        for i in range(n):
            a, b = row * n + i, row * n + (i + 1) % n
            faces += [(a, a + n, b)] if row > 0 else []
            faces += [(b, a + n, b + n)] if row < last else []
    return TriMesh(vertices.astype(np.float32), np.array(faces, dtype=np.int32))


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
