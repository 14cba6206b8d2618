"""One robot or free body → its part of the engine's arrays."""

import itertools
from collections.abc import Sequence
from typing import Any

import numpy as np

from urdfkit.errors import SimulationError
from urdfkit.linear_algebra import Array, matmul, vector_norm
from urdfkit.sim.engine.bodies import Body, Member
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, PLANAR, PRISMATIC, REVOLUTE
from urdfkit.sim.engine.math.simd import STRIP
from urdfkit.sim.engine.simulation_memory import Arrays

KINDS = {1: (PRISMATIC, REVOLUTE), 3: (PLANAR, PLANAR), 6: (FREE, FREE)}
"""Number of dofs → kind of joint that only shifts, kind of any other."""
UPPER = ((0, 0, 0, 1, 1, 2), (0, 1, 2, 1, 2, 2))
"""Rows and columns of a symmetric tensor's six entries."""


def pose_matrix(pose: Sequence[float]) -> Array:
    """Return x y z and a quaternion x y z w as a homogeneous matrix.

    Raises:
        SimulationError: the pose is invalid.
    """
    import pinocchio as pin

    values = np.array(pose, dtype=float)
    if values.shape != (7,) or not np.isfinite(values).all() or not vector_norm(values[3:]) > 1e-9:
        raise SimulationError("the pose of a base or body is x y z and a quaternion x y z w that is not zero")
    values[3:] /= vector_norm(values[3:])
    return np.array(pin.XYZQUATToSE3(values).homogeneous)


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


def fill_member(arrays: Arrays, tree: int, member: Member) -> None:
    """Write a robot's bodies, dofs and mimic joints."""
    kinematics = member.kinematics
    model: Any = kinematics.model
    base = pose_matrix(member.base)
    first_body, first_dof = int(arrays["tree_body"][tree]), int(arrays["tree_dof"][tree])
    at = int(arrays["tree_s"][tree])
    arrays["base"][tree] = base[:3, 3]
    arrays["tree_floats"][tree] = kinematics.floating_base
    for k in range(model.njoints - 1):
        b = first_body + k
        joint, inertia = model.joints[k + 1], model.inertias[k + 1]
        placement = model.jointPlacements[k + 1].homogeneous
        parent = int(model.parents[k + 1]) - 1
        if parent < 0 and not kinematics.floating_base:
            placement = matmul(base, placement)
        subspace = joint_subspace(model, k + 1)
        arrays["kind"][b] = KINDS[joint.nv][1 if subspace[3:].any() else 0]
        arrays["parent"][b] = -1 if parent < 0 else first_body + parent
        arrays["place_R"][b] = placement[:3, :3].ravel()
        arrays["place_p"][b] = placement[:3, 3]
        arrays["mass"][b] = inertia.mass
        arrays["centre"][b] = inertia.lever
        arrays["tensor"][b] = inertia.inertia[UPPER]
        d = first_dof + joint.idx_v
        above = arrays["body_last_dof"][first_body + parent] if parent >= 0 else -1
        at = _fill_joint(arrays, b, d, at, subspace, int(above))
        if joint.nq == joint.nv == 1:
            arrays["lower"][d] = model.lowerPositionLimit[joint.idx_q]
            arrays["upper"][d] = model.upperPositionLimit[joint.idx_q]
    for k, name in enumerate(kinematics.link_names, int(arrays["tree_link"][tree])):
        frame = model.frames[kinematics.frame(name)]
        placement = frame.placement.homogeneous
        if frame.parentJoint == 0:
            placement = matmul(base, placement)
        arrays["link_body"][k] = first_body + frame.parentJoint - 1 if frame.parentJoint else -1
        arrays["link_R"][k], arrays["link_p"][k] = placement[:3, :3].ravel(), placement[:3, 3]
    _fill_weightless(arrays, first_body, member)
    beyond = first_dof + model.nv
    arrays["damping"][first_dof:beyond] = model.damping
    arrays["friction"][first_dof:beyond] = model.upperDryFrictionLimit
    for k, name in enumerate(kinematics.mimic_names, int(arrays["tree_mimic"][tree])):
        coupling = kinematics.couplings[name]
        arrays["mimic_dof"][k] = first_dof + kinematics.velocity_index(coupling.joint)
        master = -1 if coupling.master is None else first_dof + kinematics.velocity_index(coupling.master)
        arrays["mimic_master"][k] = master
        arrays["mimic_factor"][k], arrays["mimic_offset"][k] = coupling.multiplier, coupling.offset


def _fill_weightless(arrays: Arrays, first_body: int, member: Member) -> None:
    """Write the mass and centre of what gravity does not pull, of each body the links that are fixed to it."""
    kinematics = member.kinematics
    masses = arrays["weightless"]
    for name in member.weightless:
        frame = kinematics.model.frames[kinematics.frame(name)]
        inertial = kinematics.robot.link_by_name[name].inertial
        if inertial is None or frame.parentJoint == 0:
            continue
        b = first_body + frame.parentJoint - 1
        centre = frame.placement.act(np.array(inertial.origin.xyz, dtype=float))
        arrays["weightless_centre"][b] *= masses[b]
        arrays["weightless_centre"][b] += inertial.mass * centre
        masses[b] += inertial.mass
        arrays["weightless_centre"][b] /= max(masses[b], np.finfo(float).tiny)


def fill_free(arrays: Arrays, tree: int, body: Body) -> None:
    """Write a free body, at its pose and at rest.

    Raises:
        SimulationError: it has no mass or an impossible inertia.
    """
    tensor = np.array(body.inertia, dtype=float)
    sound = np.isfinite(tensor).all() and np.isfinite(body.mass) and body.mass > 0.0
    if not sound or not np.linalg.eigvalsh(tensor)[0] > 0.0:
        raise SimulationError(
            f"body `{body.name}` cannot move: its mass is {body.mass:g} kg; give it a mass and an inertia greater than "
            "zero, or make it static"
        )
    b = int(arrays["tree_body"][tree])
    at = int(arrays["tree_s"][tree])
    arrays["tree_floats"][tree] = 1
    arrays["kind"][b], arrays["parent"][b] = FREE, -1
    arrays["place_R"][b] = np.eye(3).ravel()
    arrays["mass"][b], arrays["centre"][b], arrays["tensor"][b] = body.mass, body.centre, tensor[UPPER]
    arrays["weightless"][b], arrays["weightless_centre"][b] = body.weightless, body.weightless_centre
    _fill_joint(arrays, b, int(arrays["tree_dof"][tree]), at, np.eye(6), -1)
    place_free(arrays, tree, body.pose)


def place_free(arrays: Arrays, tree: int, pose: Sequence[float]) -> None:
    """Put a free body somewhere."""
    pose_matrix(pose)
    at = int(arrays["tree_s"][tree])
    values = np.array(pose, dtype=float)
    arrays["s"][at : at + 3] = values[:3]
    arrays["s"][at + 3 : at + 7] = values[3:] / vector_norm(values[3:])


def _fill_joint(arrays: Arrays, b: int, first: int, at: int, subspace: Array, above: int) -> int:
    """Write the joint of body b; return where the coordinates of the next one start."""
    n = subspace.shape[1]
    arrays["first_s"][b] = at
    arrays["first_v"][b], arrays["first_v"][b + 1] = first, first + n
    arrays["body_last_dof"][b] = first + n - 1
    for k in range(n):
        d = first + k
        arrays["subspace"][d] = subspace[:, k]
        arrays["dof_s"][d] = at + k
        arrays["dof_parent"][d] = d - 1 if k else above
    return at + (n if n < 6 else 7)


def branch_entries(dofs: int) -> int:
    """Return how many entries the branches of a tree of so many dofs need."""
    return dofs * -(-dofs // STRIP) * STRIP


def fill_branches(arrays: Arrays) -> None:
    """Write which dofs carry each dof, from the root on, and itself."""
    parents, firsts = arrays["dof_parent"].tolist(), arrays["tree_dof"].tolist()
    at = 0
    for first, beyond in itertools.pairwise(firsts):
        branches: dict[int, list[int]] = {-1: []}
        for d in range(first, beyond):
            branches[d] = [*branches[parents[d]], d]
            arrays["dof_branch"][d], arrays["dof_depth"][d] = at, len(branches[d]) - 1
            arrays["branch"][at : at + len(branches[d])] = branches[d]
            at += branch_entries(beyond - first) // (beyond - first)
