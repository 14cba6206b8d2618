"""Collision shapes of robots and bodies in the form that the kernel uses."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from urdfkit.description.sdf import Plane
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.scene import Shape
from urdfkit.sim.engine.bodies import Body, Member
from urdfkit.sim.engine.collision.support_points import HULL, MESH, PLANE
from urdfkit.sim.engine.contact_surface import Surface, Touching
from urdfkit.sim.engine.contacts import ground_contacts
from urdfkit.sim.engine.layout.tree_arrays import pose_matrix
from urdfkit.sim.engine.layout.wheel_shapes import as_wheel

BOUNDLESS = 1e9
"""Radius of the ball round a plane [m]."""


def touching(members: Sequence[Member], bodies: Sequence[Body]) -> list[Touching]:
    """Return the collision shapes: those of trees in the order of the trees, then static ones."""
    moving, still = [], []
    first = 0
    for owner, member in enumerate(members):
        model = member.kinematics.model
        prefix = f"{member.name}::" if member.name else ""
        base = pose_matrix(member.base)
        numbers: Counter[str] = Counter()
        for shape in member.shapes:
            if shape.role != "collision":
                continue
            frame = model.frames[member.kinematics.frame(shape.body)]
            placement = matmul(frame.placement.homogeneous, shape.placement)
            surface, link = member.surfaces.get(shape.body, Surface()), prefix + shape.body
            number = numbers[shape.body]
            numbers[shape.body] += 1
            is_fixed = frame.parentJoint == 0
            at = -1 if is_fixed else first + frame.parentJoint - 1
            touch = _touch(shape, surface, link, at, owner, matmul(base, placement) if is_fixed else placement)
            touch = replace(touch, number=number, meets=member.meets(shape.body))
            if surface.frame:
                other = model.frames[member.kinematics.frame(surface.frame)]
                axes = matmul((base if other.parentJoint == 0 else np.eye(4))[:3, :3], other.placement.rotation)
                on = -1 if other.parentJoint == 0 else first + other.parentJoint - 1
                touch = replace(touch, along=matmul(axes, np.array(surface.fdir1 or (0.0, 0.0, 0.0))), along_body=on)
            if is_fixed:
                still.append(touch)
                continue
            moving.append(as_wheel(touch, member.kinematics, frame.parentJoint))
        first += model.njoints - 1
    for owner, body in enumerate(bodies, len(members)):
        pose = pose_matrix(body.pose) if body.static else np.eye(4)
        for number, piece in enumerate(body.pieces):
            at = -1 if body.static else first
            touch = _touch(piece.shape, piece.surface, body.name, at, owner, matmul(pose, piece.shape.placement))
            (still if body.static else moving).append(replace(touch, number=number))
        first += not body.static
    return moving + still


def _touch(shape: Shape, surface: Surface, link: str, body: int, owner: int, placement: Array) -> Touching:
    kind, size, vertices = _solid(shape)
    triangles = np.zeros((0, 3, 3))
    if kind == HULL and body < 0 and shape.mesh is not None:
        # Static meshes are used as they are, moving ones as their convex hull.
        kind, triangles = MESH, np.asarray(shape.mesh.vertices, dtype=np.float64)[shape.mesh.faces]
    radius = vector_norm(size) if kind != ground_contacts.CAPSULE else size[0] + size[1]
    if kind == ground_contacts.SPHERE:
        radius = size[0]
    elif kind in (HULL, MESH):
        radius = float(np.linalg.norm(vertices, axis=1).max())
    elif kind == PLANE:
        radius = BOUNDLESS
    R, p = placement[:3, :3], placement[:3, 3]
    along = matmul(R, np.array(surface.fdir1 or (0.0, 0.0, 0.0)))
    return Touching(
        link,
        0,
        body,
        owner,
        False,
        kind,
        size,
        R,
        p,
        radius,
        surface.mu1,
        surface.mu2,
        along,
        body,
        vertices,
        triangles,
    )


def _solid(shape: Shape) -> tuple[int, tuple[float, float, float], Array]:
    """Return kind, size and vertices of a shape."""
    none = np.zeros((0, 3))
    geometry = shape.geometry
    if isinstance(geometry, Sphere):
        return ground_contacts.SPHERE, (geometry.radius, 0.0, 0.0), none
    if isinstance(geometry, Box):
        x, y, z = geometry.size
        return ground_contacts.BOX, (x / 2, y / 2, z / 2), none
    if isinstance(geometry, Cylinder):
        return ground_contacts.CYLINDER, (geometry.radius, geometry.length / 2, 0.0), none
    if isinstance(geometry, Capsule):
        return ground_contacts.CAPSULE, (geometry.radius, geometry.length / 2, 0.0), none
    if isinstance(geometry, Plane):
        return PLANE, (0.0, 0.0, 0.0), none
    assert isinstance(geometry, Mesh)
    if shape.mesh is None:
        raise SimulationError(f"collision `{shape.name}` is a mesh that was not loaded")
    return HULL, (0.0, 0.0, 0.0), hull_vertices(np.asarray(shape.mesh.vertices, dtype=float))


def hull_vertices(points: Array) -> Array:
    """Return the corners of the convex hull of points; the points themselves where they lie in a plane."""
    import trimesh

    try:
        return np.array(trimesh.convex.convex_hull(points).vertices, dtype=float)
    except Exception:  # qhull's own error class is not public
        return np.unique(points, axis=0)


def box_of(touch: Touching) -> tuple[Array, Array]:
    """Return middle and half edges [m] of the box along a shape's own axes that holds it."""
    none, (x, y, z) = np.zeros(3), touch.size
    if touch.kind == ground_contacts.SPHERE:
        return none, np.full(3, x)
    if touch.kind in (ground_contacts.CYLINDER, ground_contacts.WHEEL):
        return none, np.array([x, x, y])
    if touch.kind == ground_contacts.CAPSULE:
        return none, np.array([x, x, x + y])
    if touch.kind == ground_contacts.BOX:
        return none, np.array([x, y, z])
    if touch.kind == PLANE:
        return none, np.full(3, BOUNDLESS)
    low, high = touch.vertices.min(axis=0), touch.vertices.max(axis=0)
    return 0.5 * (low + high), 0.5 * (high - low)


def still_box(touch: Touching) -> tuple[Array, Array]:
    """Return middle and half edges [m] of the box along the world's axes that holds a shape that does not move."""
    if touch.kind in (HULL, MESH):
        corners = matmul(touch.vertices, touch.R.T) + touch.p
        low, high = corners.min(axis=0), corners.max(axis=0)
        return 0.5 * (low + high), 0.5 * (high - low)
    return touch.p, matmul(np.abs(touch.R), box_of(touch)[1])
