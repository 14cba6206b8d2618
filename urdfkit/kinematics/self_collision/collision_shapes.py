"""Collision shapes of links for coal: convex shapes to decide most pairs of links, and triangles where they overlap."""

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from urdfkit.description.urdf.robot import Box, Capsule, Collision, Cylinder, Link, Mesh, Pose, Robot, Sphere
from urdfkit.errors import ResourceError
from urdfkit.kinematics.pinocchio_model import pin
from urdfkit.linear_algebra import Array
from urdfkit.meshes.loader import MeshLoader
from urdfkit.meshes.triangle_mesh import TriMesh

CONVEX = 1e-3
"""Part of the volume of a hull that a mesh may lack and still count as convex."""


@dataclass(frozen=True)
class CollisionShape:
    """A collision shape in the frame of its link.

    Attributes:
        convex: coal's shape; for a mesh its convex hull.
        exact: triangles of a mesh that is not convex, as a coal.BVHModel; None for other shapes.
        rotation: from the frame of the shape to that of the link; shape (3, 3).
        translation: [m]; shape (3,).
        low: lowest corner of the bounding box in the frame of the link [m]; shape (3,).
        high: highest corner [m]; shape (3,).
    """

    convex: Any
    exact: Any
    rotation: Array
    translation: Array
    low: Array
    high: Array


def shapes_by_link(robot: Robot, note: Callable[[str], None] | None = None) -> dict[str, tuple[CollisionShape, ...]]:
    """Return the collision shapes of each link that has any, in document order.

    Args:
        robot: the robot.
        note: called with a message for a mesh that cannot be read; its shape is ignored.

    Raises:
        ResourceError: a mesh cannot be read, and `note` is None.
    """
    loader = MeshLoader()
    found = {link.name: tuple(_shapes(robot, link, loader, note)) for link in robot.links}
    return {name: shapes for name, shapes in found.items() if shapes}


def box_around(shapes: tuple[CollisionShape, ...]) -> tuple[Array, Array]:
    """Return centre and half sizes of the box around shapes, in the axes of their link."""
    low = np.min([shape.low for shape in shapes], axis=0)
    high = np.max([shape.high for shape in shapes], axis=0)
    return (low + high) / 2.0, (high - low) / 2.0


def neighbours(robot: Robot, shapes: Collection[str]) -> set[tuple[str, str]]:
    """Return the pairs of links that a joint connects, directly or through links without shapes; both orders.

    A link whose shapes cannot be read does not count as one without shapes.

    Args:
        robot: the robot.
        shapes: names of the links with shapes that can be read.
    """
    found = set()
    touching: dict[str, list[str]] = {}
    for joint in robot.joints:
        if joint.parent is not None and joint.child is not None:
            touching.setdefault(joint.parent, []).append(joint.child)
            touching.setdefault(joint.child, []).append(joint.parent)
    for name in shapes:
        waiting, seen = [name], {name}
        while waiting:
            for other in touching.get(waiting.pop(), ()):
                if other in seen:
                    continue
                seen.add(other)
                if other in shapes:
                    found.add((name, other))
                elif not robot.link_by_name[other].collisions:
                    waiting.append(other)
    return found


def incomplete_links(robot: Robot, shapes: Mapping[str, tuple[CollisionShape, ...]]) -> tuple[str, ...]:
    """Return the links that have collision shapes which cannot be read, in document order."""
    return tuple(link.name for link in robot.links if len(shapes.get(link.name, ())) < len(link.collisions))


def _shapes(robot: Robot, link: Link, loader: MeshLoader, note: Callable[[str], None] | None) -> list[CollisionShape]:
    shapes = []
    for collision in link.collisions:
        try:
            shape = _shape(robot, collision, loader)
        except ResourceError as error:
            mesh = next((each for each in collision.element.walk() if each.tag == "mesh"), collision.element)
            position = mesh.origin.position
            if note is None:
                raise error.at(position) from error
            note(f"{position}: link `{link.name}`: a collision shape is ignored: {error.message}")
            continue
        if shape is not None:
            shapes.append(shape)
    return shapes


def _shape(robot: Robot, collision: Collision, loader: MeshLoader) -> CollisionShape | None:
    import coal

    geometry, (rotation, translation) = collision.geometry, placement(collision.origin)
    exact = None
    if isinstance(geometry, Mesh):
        if robot.packages is None:
            return None
        path = robot.packages.resolve(geometry.uri.strip(), Path(robot.files[0]))
        mesh = loader.load(path, geometry.scale)
        convex, exact = _hull(mesh)
        if convex is None:
            return None
        corners = mesh.vertices.astype(float) @ rotation.T + translation
        return CollisionShape(convex, exact, rotation, translation, corners.min(axis=0), corners.max(axis=0))
    if isinstance(geometry, Box):
        convex, half = coal.Box(*geometry.size), np.array(geometry.size) / 2.0
    elif isinstance(geometry, Sphere):
        convex, half = coal.Sphere(geometry.radius), np.full(3, geometry.radius)
    elif isinstance(geometry, Cylinder):
        convex = coal.Cylinder(geometry.radius, geometry.length)
        half = np.array([geometry.radius, geometry.radius, geometry.length / 2.0])
    elif isinstance(geometry, Capsule):
        convex = coal.Capsule(geometry.radius, geometry.length)
        half = np.array([geometry.radius, geometry.radius, geometry.length / 2.0 + geometry.radius])
    else:
        return None
    if not (half > 0.0).all():
        return None
    extent = np.abs(rotation) @ half
    return CollisionShape(convex, exact, rotation, translation, translation - extent, translation + extent)


def placement(origin: Pose) -> tuple[Array, Array]:
    """Return rotation (3, 3) and translation (3,) of an origin."""
    return np.array(pin.rpy.rpyToMatrix(*origin.rpy)), np.array(origin.xyz)


def _hull(mesh: TriMesh) -> tuple[Any, Any]:
    """Return the convex hull of a mesh, and its triangles unless it is convex; None and None for a flat mesh."""
    import coal

    vertices = np.unique(mesh.vertices.astype(float), axis=0)
    points = coal.StdVec_Vec3s()
    for vertex in vertices:
        points.append(vertex)
    try:
        hull = coal.ConvexBase.convexHull(points, True, "Qt")
    except (RuntimeError, ValueError):  # flat
        return None, None
    a, b, c = (mesh.vertices[mesh.faces[:, corner]].astype(float) for corner in range(3))
    volume = abs(float(np.einsum("ij,ij", a, np.cross(b, c)))) / 6.0
    whole = hull.computeVolume()
    if whole <= 0.0 or volume >= (1.0 - CONVEX) * whole:
        return hull, None
    triangles, corners = coal.StdVec_Triangle(), coal.StdVec_Vec3s()
    for vertex in mesh.vertices.astype(float):
        corners.append(vertex)
    for face in mesh.faces.tolist():
        triangles.append(coal.Triangle(*face))
    model = coal.BVHModelOBBRSS()
    model.beginModel(len(mesh.faces), len(mesh.vertices))
    model.addSubModel(corners, triangles)
    model.endModel()
    return hull, model
