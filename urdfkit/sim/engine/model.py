"""Kinematics and shapes → the engine's arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from urdfkit.description.robot import Box, Capsule, Cylinder, Mesh, Sphere
from urdfkit.errors import SimulationError
from urdfkit.kinematics.model import Kinematics
from urdfkit.scene import Shape
from urdfkit.sim.engine import collide
from urdfkit.sim.engine.arrays import DT, FLOOR, HAS_FLOOR, Arrays, allocate
from urdfkit.sim.engine.dynamics import FREE, PLANAR, PRISMATIC, REVOLUTE
from urdfkit.sim.engine.surface import Ground, Surface

Array = NDArray[np.float64]

KINDS = {1: (PRISMATIC, REVOLUTE), 3: (PLANAR, PLANAR), 6: (FREE, FREE)}
"""Number of dofs → kind of joint that only shifts, kind of any other."""


@dataclass(frozen=True, slots=True, eq=False)
class Touching:
    """A collision shape on a moving body, as the kernel knows it.

    Attributes:
        link: the link it belongs to.
        joint: Pinocchio's joint that moves it.
        kind: of shape.
        size: [m], see `collide`.
        R: axes in the body.
        p: centre in the body [m].
        radius: of a ball round the centre that holds the shape [m].
        mu: friction coefficient of the pair with the ground.
        vertices: of a hull [m], shape (n, 3).
    """

    link: str
    joint: int
    kind: int
    size: tuple[float, float, float]
    R: Array
    p: Array
    radius: float
    mu: float
    vertices: Array


def touching(
    kinematics: Kinematics, shapes: Sequence[Shape], surfaces: Mapping[str, Surface], ground: Ground | None
) -> list[Touching]:
    """Return what can touch the ground: the collision shapes of links that move."""
    found = []
    for shape in shapes:
        frame = kinematics.model.frames[kinematics.frame(shape.body)]
        if shape.role != "collision" or frame.parentJoint == 0:
            continue
        placement = frame.placement.homogeneous @ shape.placement
        kind, size, vertices = _solid(shape)
        if kind == collide.CYLINDER and _turns_about(kinematics, frame.parentJoint, placement):
            kind = collide.WHEEL
        radius = float(np.linalg.norm(size)) if kind != collide.CAPSULE else size[0] + size[1]
        if kind in (collide.SPHERE, collide.HULL):
            radius = size[0] if kind == collide.SPHERE else float(np.linalg.norm(vertices, axis=1).max())
        mu = surfaces.get(shape.body, Surface()).mu
        if ground is not None:
            mu = min(mu, ground.mu)
        found.append(
            Touching(
                shape.body,
                int(frame.parentJoint),
                kind,
                size,
                placement[:3, :3],
                placement[:3, 3],
                radius,
                mu,
                vertices,
            )
        )
    return found


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
    assert isinstance(geometry, Mesh)
    if shape.mesh is None:
        raise SimulationError(f"collision `{shape.name}` is a mesh that was not loaded")
    return collide.HULL, (0.0, 0.0, 0.0), hull_vertices(np.asarray(shape.mesh.vertices, dtype=float))


def hull_vertices(points: Array) -> Array:
    """Return the corners of the convex hull of points; the points themselves where they lie in a plane."""
    import trimesh

    try:
        return np.array(trimesh.convex.convex_hull(points).vertices, dtype=float)
    except Exception:  # qhull's own error class is not public
        return np.unique(points, axis=0)


def _turns_about(kinematics: Kinematics, joint: int, placement: Array) -> bool:
    """Return whether a cylinder is a wheel: its axis is that of the revolute joint that carries it."""
    subspace = joint_subspace(kinematics.model, joint)
    if subspace.shape[1] != 1 or not subspace[3:, 0].any():
        return False
    axis = subspace[3:, 0]
    along = np.cross(axis, placement[:3, 2])
    off = placement[:3, 3] - axis * (axis @ placement[:3, 3])
    return bool(np.linalg.norm(along) < 1e-3 and np.linalg.norm(off) < 1e-3)


def joint_subspace(model: Any, joint: int) -> Array:
    """Return the motion subspace of a joint in the frame it moves, linear first; shape (6, nv of the joint)."""
    kind = model.joints[joint]
    state = kind.createData()
    q = np.zeros(model.nq)
    q[kind.idx_q : kind.idx_q + kind.nq] = _neutral(kind)
    kind.calc(state, q, np.zeros(model.nv))
    return np.array(state.S, dtype=float).reshape(6, kind.nv)


def _neutral(kind: Any) -> list[float]:
    return {1: [0.0], 2: [1.0, 0.0], 4: [0.0, 0.0, 1.0, 0.0], 7: [0, 0, 0, 0, 0, 0, 1.0]}[kind.nq]


def fill(
    kinematics: Kinematics,
    touches: Sequence[Touching],
    *,
    dt: float,
    gravity: Sequence[float],
    ground: Ground | None,
    base: Array,
) -> Arrays:
    """Return the arrays of a robot with these shapes."""
    model = kinematics.model
    bodies, dofs = model.njoints - 1, model.nv
    joints = [model.joints[i] for i in range(1, model.njoints)]
    widths = [joint.nv if joint.nv < 6 else 7 for joint in joints]
    features = [_features(touch) for touch in touches]
    contacts = sum(min(collide.MOST[touch.kind], n) for touch, n in zip(touches, features, strict=True))
    mimics = [kinematics.couplings[name] for name in kinematics.mimic_names]
    rows = len(mimics) + 2 * dofs + 3 * contacts
    slots = 2 * dofs + len(mimics) + 3 * sum(features)
    vertices = sum(len(touch.vertices) for touch in touches)
    sizes = (bodies, dofs, sum(widths), len(touches), vertices, len(mimics), contacts, rows, slots)
    arrays = allocate(sizes, floating=kinematics.floating_base)
    arrays["numbers"][[DT, FLOOR, HAS_FLOOR]] = dt, ground.height if ground else 0.0, ground is not None
    arrays["gravity"][:] = gravity
    arrays["base"][:] = base[:3, 3]
    _fill_bodies(arrays, kinematics, widths, base)
    _fill_dofs(arrays, model)
    for k, coupling in enumerate(mimics):
        arrays["mimic_dof"][k] = kinematics.velocity_index(coupling.joint)
        arrays["mimic_master"][k] = -1 if coupling.master is None else kinematics.velocity_index(coupling.master)
        arrays["mimic_factor"][k], arrays["mimic_offset"][k] = coupling.multiplier, coupling.offset
    _fill_shapes(arrays, touches, features)
    return arrays


def _features(touch: Touching) -> int:
    return len(touch.vertices) if touch.kind == collide.HULL else collide.FEATURES[touch.kind]


def _fill_bodies(arrays: Arrays, kinematics: Kinematics, widths: Sequence[int], base: Array) -> None:
    model = kinematics.model
    arrays["first_s"][:] = np.cumsum([0, *widths[:-1]])
    arrays["body_last_dof"][:] = -1
    for b in range(model.njoints - 1):
        joint, inertia = model.joints[b + 1], model.inertias[b + 1]
        placement = model.jointPlacements[b + 1].homogeneous
        parent = int(model.parents[b + 1]) - 1
        if parent < 0 and not kinematics.floating_base:
            placement = base @ placement
        subspace = joint_subspace(model, b + 1)
        shifts = not subspace[3:].any()
        arrays["kind"][b] = KINDS[joint.nv][0 if shifts else 1]
        arrays["parent"][b] = parent
        arrays["place_R"][b] = placement[:3, :3].ravel()
        arrays["place_p"][b] = placement[:3, 3]
        arrays["mass"][b] = inertia.mass
        arrays["centre"][b] = inertia.lever
        arrays["tensor"][b] = inertia.inertia[[0, 0, 0, 1, 1, 2], [0, 1, 2, 1, 2, 2]]
        first = joint.idx_v
        arrays["first_v"][b], arrays["first_v"][b + 1] = first, first + joint.nv
        arrays["body_last_dof"][b] = first + joint.nv - 1
        for k in range(joint.nv):
            d = first + k
            arrays["subspace"][d] = subspace[:, k]
            arrays["dof_s"][d] = arrays["first_s"][b] + k
            arrays["dof_parent"][d] = d - 1 if k else (arrays["body_last_dof"][parent] if parent >= 0 else -1)


def _fill_dofs(arrays: Arrays, model: Any) -> None:
    arrays["damping"][:] = model.damping
    arrays["friction"][:] = model.upperDryFrictionLimit
    arrays["lower"][:] = -np.inf
    arrays["upper"][:] = np.inf
    arrays["servo_effort"][:] = np.inf
    for joint in list(model.joints)[1:]:
        if joint.nq == joint.nv == 1:
            arrays["lower"][joint.idx_v] = model.lowerPositionLimit[joint.idx_q]
            arrays["upper"][joint.idx_v] = model.upperPositionLimit[joint.idx_q]


def _fill_shapes(arrays: Arrays, touches: Sequence[Touching], features: Sequence[int]) -> None:
    feature = vertex = 0
    for k, touch in enumerate(touches):
        arrays["shape_kind"][k] = touch.kind
        arrays["shape_body"][k] = touch.joint - 1
        arrays["shape_feature"][k] = feature
        arrays["shape_vertex"][k] = vertex
        arrays["shape_R"][k] = touch.R.ravel()
        arrays["shape_p"][k] = touch.p
        arrays["shape_size"][k] = touch.size
        arrays["shape_radius"][k] = touch.radius
        arrays["shape_mu"][k] = touch.mu
        arrays["vertices"][vertex : vertex + len(touch.vertices)] = touch.vertices
        feature += features[k]
        vertex += len(touch.vertices)
    arrays["shape_vertex"][len(touches)] = vertex
