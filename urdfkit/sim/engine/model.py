"""Robots, bodies and shapes → the engine's arrays."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.description.world import Plane
from urdfkit.errors import SimulationError
from urdfkit.scene import Shape
from urdfkit.sim.engine import collide
from urdfkit.sim.engine.arrays import Arrays, allocate
from urdfkit.sim.engine.body import Body, Member
from urdfkit.sim.engine.pairs.collide_pair import MOST
from urdfkit.sim.engine.pairs.geometry import Geometry
from urdfkit.sim.engine.pairs.hull import convex_hull
from urdfkit.sim.engine.pairs.shapes import HULL, MESH, PLANE
from urdfkit.sim.engine.surface import Ground, Surface
from urdfkit.sim.engine.tree import fill_free, fill_member, pose_matrix
from urdfkit.sim.engine.wheels import as_wheel

Array = NDArray[np.float64]

MOST_PAIRS = 32768
"""Most pairs of shapes whose boxes may overlap at once."""
BOUNDLESS = 1e9
"""Radius of the ball round a plane [m]."""
MOST_ROWS = 1500
"""Most rows that one island may have; its matrix has the square of that."""


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """A collision shape, as the kernel knows it.

    Attributes:
        link: what contacts call it.
        body: number of the body it is on; -1 when it does not move, and then it is placed in the world.
        owner: number of the robot or body it belongs to.
        meets: whether it touches others of its owner.
        kind: of shape.
        size: [m], see `collide`.
        R: axes in the body.
        p: centre in the body [m].
        radius: of a ball round the centre that holds the shape [m].
        mu: friction coefficient along `along`.
        mu2: across it.
        along: direction of `mu`, in `along_body` or, if that is -1, in the world; zero for none.
        along_body: number of the body it turns with.
        vertices: of a hull or mesh [m], shape (n, 3).
        triangles: of a mesh [m], shape (m, 3, 3); of a hull those it was made from do not matter.
    """

    link: str
    body: int
    owner: int
    meets: bool
    kind: int
    size: tuple[float, float, float]
    R: Array
    p: Array
    radius: float
    mu: float
    mu2: float
    along: Array
    along_body: int
    vertices: Array
    triangles: Array


def touching(members: Sequence[Member], bodies: Sequence[Body]) -> list[Touching]:
    """Return what can touch: the shapes of what moves in the order of their trees, then what does not move."""
    moving, still = [], []
    first = 0
    for owner, member in enumerate(members):
        model = member.kinematics.model
        prefix = f"{member.name}::" if member.name else ""
        base = pose_matrix(member.base)
        for shape in member.shapes:
            if shape.role != "collision":
                continue
            frame = model.frames[member.kinematics.frame(shape.body)]
            placement = frame.placement.homogeneous @ shape.placement
            surface, link = member.surfaces.get(shape.body, Surface()), prefix + shape.body
            bolted = frame.parentJoint == 0
            at = -1 if bolted else first + frame.parentJoint - 1
            touch = _touch(shape, surface, link, at, owner, base @ placement if bolted else placement)
            touch = replace(touch, meets=member.meets(shape.body))
            if surface.frame:
                other = model.frames[member.kinematics.frame(surface.frame)]
                axes = (base if other.parentJoint == 0 else np.eye(4))[:3, :3] @ other.placement.rotation
                on = -1 if other.parentJoint == 0 else first + other.parentJoint - 1
                touch = replace(touch, along=axes @ np.array(surface.fdir1 or (0.0, 0.0, 0.0)), along_body=on)
            if bolted:
                still.append(touch)
                continue
            moving.append(as_wheel(touch, member.kinematics, frame.parentJoint))
        first += model.njoints - 1
    for owner, body in enumerate(bodies, len(members)):
        pose = pose_matrix(body.pose) if body.static else np.eye(4)
        for piece in body.pieces:
            at = -1 if body.static else first
            touch = _touch(piece.shape, piece.surface, body.name, at, owner, pose @ piece.shape.placement)
            (still if body.static else moving).append(touch)
        first += not body.static
    return moving + still


def _touch(shape: Shape, surface: Surface, link: str, body: int, owner: int, placement: Array) -> Touching:
    kind, size, vertices = _solid(shape)
    triangles = np.zeros((0, 3, 3))
    if kind == HULL and body < 0 and shape.mesh is not None:
        # What does not move is taken as it is; what moves for its convex hull.
        kind, triangles = MESH, np.asarray(shape.mesh.vertices, dtype=np.float64)[shape.mesh.faces]
    radius = float(np.linalg.norm(size)) if kind != collide.CAPSULE else size[0] + size[1]
    if kind == collide.SPHERE:
        radius = size[0]
    elif kind in (HULL, MESH):
        radius = float(np.linalg.norm(vertices, axis=1).max())
    elif kind == PLANE:
        radius = BOUNDLESS
    R, p = placement[:3, :3], placement[:3, 3]
    along = R @ np.array(surface.fdir1 or (0.0, 0.0, 0.0))
    return Touching(
        link, body, owner, False, kind, size, R, p, radius, surface.mu1, surface.mu2, along, body, vertices, triangles
    )


def _solid(shape: Shape) -> tuple[int, tuple[float, float, float], Array]:
    """Return kind, size and vertices of a shape."""
    none = np.zeros((0, 3))
    geometry = shape.geometry
    if isinstance(geometry, Sphere):
        return collide.SPHERE, (geometry.radius, 0.0, 0.0), none
    if isinstance(geometry, Box):
        x, y, z = geometry.size
        return collide.BOX, (x / 2, y / 2, z / 2), none
    if isinstance(geometry, Cylinder):
        return collide.CYLINDER, (geometry.radius, geometry.length / 2, 0.0), none
    if isinstance(geometry, Capsule):
        return collide.CAPSULE, (geometry.radius, geometry.length / 2, 0.0), none
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


def fill(
    members: Sequence[Member],
    bodies: Sequence[Body],
    touches: Sequence[Touching],
    *,
    dt: float,
    gravity: Sequence[float],
    ground: Ground | None,
    sleep: bool = False,
) -> Arrays:
    """Return the arrays of a world of robots and bodies with these shapes, which may `sleep` or never do."""
    free = [body for body in bodies if not body.static]
    models = [member.kinematics.model for member in members]
    joints = [[model.joints[i].nv for i in range(1, model.njoints)] for model in models] + [[6]] * len(free)
    dofs = [sum(each) for each in joints]
    widths = [sum(nv if nv < 6 else 7 for nv in each) for each in joints]
    features = [_features(touch) for touch in touches]
    geometry = Geometry()
    moving = [touch for touch in touches if touch.body >= 0]
    mimics = [len(member.kinematics.mimic_names) for member in members] + [0] * len(free)
    owners = {touch.owner for touch in touches}
    meets = len(owners) > 1 or any(touch.meets for touch in touches)
    places = [_add(geometry, touch) if meets else 0 for touch in touches]
    pairs = min(MOST_PAIRS, len(moving) * len(touches)) if meets else 0
    contacts = sum(
        min(collide.MOST[touch.kind], n) for touch, n in zip(touches, features, strict=True) if touch.body >= 0
    )
    contacts += min(pairs * MOST, 64 + 16 * len(moving)) if meets else 0
    rows = min(MOST_ROWS, sum(mimics) + 2 * sum(dofs) + 3 * contacts)
    slots = 2 * sum(dofs) + sum(mimics) + 3 * (sum(features) + contacts)
    vertices = sum(len(touch.vertices) for touch in touches)
    width = max(dofs, default=0) * (2 if meets else 1)
    entries = sum(n * n for n in dofs)
    sizes = (
        sum(len(each) for each in joints),
        sum(dofs),
        sum(widths),
        len(touches),
        vertices,
        sum(mimics),
        contacts,
        rows,
        slots,
        len(joints),
        entries,
        rows * width,
        rows * rows,
        pairs,
        len(geometry.numbers),
        len(geometry.indices),
    )
    arrays = allocate(sizes, width=width)
    arrays["numbers"][:] = dt, ground.height if ground else 0.0, ground is not None, meets
    arrays["gravity"][:] = gravity
    arrays["tree_body"][1:] = np.cumsum([len(each) for each in joints])
    arrays["tree_dof"][1:] = np.cumsum(dofs)
    arrays["tree_s"][1:] = np.cumsum(widths)
    arrays["tree_mimic"][1:] = np.cumsum(mimics)
    arrays["servo_effort"][:] = np.inf
    arrays["sleeps"][:] = sleep
    arrays["asked_gravity"][:] = gravity
    arrays["tree_order"][:] = np.arange(len(joints))
    arrays["lower"][:], arrays["upper"][:] = -np.inf, np.inf
    entry = 0
    for tree, n in enumerate(dofs):
        first = int(arrays["tree_dof"][tree])
        arrays["dof_row"][first : first + n] = entry + np.arange(n) * n - first
        arrays["body_tree"][arrays["tree_body"][tree] : arrays["tree_body"][tree + 1]] = tree
        entry += n * n
    for tree, member in enumerate(members):
        fill_member(arrays, tree, member)
    for tree, body in enumerate(free, len(members)):
        fill_free(arrays, tree, body)
    arrays["shape_data"][:] = places
    arrays["pair_numbers"][:], arrays["pair_indices"][:] = geometry.numbers, geometry.indices
    _fill_shapes(arrays, touches, features, 100.0 if ground is None else ground.mu)
    return arrays


def _add(geometry: Geometry, touch: Touching) -> int:
    """Add a hull or mesh to those that pairs know; return its place."""
    if touch.kind == HULL:
        return geometry.add_hull(convex_hull(touch.vertices))
    return geometry.add_mesh(touch.triangles) if touch.kind == MESH else 0


def _features(touch: Touching) -> int:
    if touch.body < 0:  # only what moves touches the ground
        return 0
    return len(touch.vertices) if touch.kind == HULL else collide.FEATURES[touch.kind]


def _fill_shapes(arrays: Arrays, touches: Sequence[Touching], features: Sequence[int], floor_mu: float) -> None:
    feature = vertex = 0
    for k, touch in enumerate(touches):
        arrays["shape_kind"][k] = touch.kind
        arrays["shape_body"][k] = touch.body
        arrays["shape_owner"][k] = touch.owner
        arrays["shape_meets"][k] = touch.meets
        arrays["shape_feature"][k] = feature
        arrays["shape_vertex"][k] = vertex
        arrays["shape_R"][k] = touch.R.ravel()
        arrays["shape_p"][k] = touch.p
        arrays["shape_size"][k] = touch.size
        arrays["shape_middle"][k], arrays["shape_half"][k] = box_of(touch)
        arrays["shape_radius"][k] = touch.radius
        arrays["shape_mu"][k] = touch.mu
        arrays["floor_mu"][k], arrays["floor_mu2"][k] = min(touch.mu, floor_mu), min(touch.mu2, floor_mu)
        arrays["shape_mu2"][k], arrays["shape_along"][k] = touch.mu2, touch.along
        arrays["along_body"][k] = touch.along_body
        arrays["vertices"][vertex : vertex + len(touch.vertices)] = touch.vertices
        feature += features[k]
        vertex += len(touch.vertices)
    arrays["shape_vertex"][len(touches)] = vertex
    for touch in touches:
        if touch.meets and touch.owner < len(arrays["tree_meets"]):
            arrays["tree_meets"][touch.owner] = 1
    trees = [int(arrays["body_tree"][touch.body]) for touch in touches if touch.body >= 0]
    arrays["tree_shape"][:] = np.searchsorted(trees, np.arange(len(arrays["tree_shape"])))
    for k in range(len(trees), len(touches)):
        arrays["shape_at"][k], arrays["shape_reach"][k] = _still_box(touches[k])


def box_of(touch: Touching) -> tuple[Array, Array]:
    """Return middle and half edges [m] of the box along a shape's own axes that holds it."""
    none, (x, y, z) = np.zeros(3), touch.size
    if touch.kind == collide.SPHERE:
        return none, np.full(3, x)
    if touch.kind in (collide.CYLINDER, collide.WHEEL):
        return none, np.array([x, x, y])
    if touch.kind == collide.CAPSULE:
        return none, np.array([x, x, x + y])
    if touch.kind == collide.BOX:
        return none, np.array([x, y, z])
    if touch.kind == PLANE:
        return none, np.full(3, BOUNDLESS)
    low, high = touch.vertices.min(axis=0), touch.vertices.max(axis=0)
    return 0.5 * (low + high), 0.5 * (high - low)


def _still_box(touch: Touching) -> tuple[Array, Array]:
    """Return middle and half edges [m] of the box along the world's axes that holds a shape that does not move."""
    if touch.kind in (HULL, MESH):
        corners = touch.vertices @ touch.R.T + touch.p
        low, high = corners.min(axis=0), corners.max(axis=0)
        return 0.5 * (low + high), 0.5 * (high - low)
    return touch.p, np.abs(touch.R) @ box_of(touch)[1]
