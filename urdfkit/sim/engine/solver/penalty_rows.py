"""Rows of a single tree for `augmented_newton`: velocities, impulses with a penalty, and their derivative."""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_transposed
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.spatial_algebra import (
    ZERO,
    add,
    cross,
    dot,
    load_spatial,
    load_vector,
    scale,
    spatial_add,
    store_spatial,
)
from urdfkit.sim.engine.simulation_memory import DOFS
from urdfkit.sim.engine.solver.tree_matrix import (
    add_product,
    assemble_tree,
    direction,
    gather_loads,
    move_bodies,
)

LEFT = 1e-7
"""Velocity [m/s] up to which penetrations and gaps stay where a load is: 0.1 nm in 1 ms; they contradict each other."""
UNKNOWN, PRESSES, STICKS, SLIPS = -1, 1, 2, 4
"""States of a contact, as a sum: its normal presses, and friction sticks or slips. Joint rows stick or do nothing."""


@inlined
def joint_row_count(w: KernelWorld, rows: int) -> int:
    """Return how many of the rows of a single tree are motors, dry friction and limits; they come first."""
    count = 0
    while count < rows and w.slot[count] < 2 * w.sizes[DOFS]:
        count += 1
    return count


@inlined
def dof_of(w: KernelWorld, k: int) -> int:
    """Return the dof of a joint row."""
    dofs, slot = w.sizes[DOFS], w.slot[k]
    return int(slot if slot < dofs else slot - dofs)


@compiled
def prepare(w: KernelWorld, tree: int, stride: int, joint_rows: int, contacts: int, inertia: Any) -> None:
    """Write an estimate of the effective mass of each joint row and contact into ``row_stiffness``."""
    first, light = w.tree_dof[tree], w.slope_s
    for d in range(first, w.tree_dof[tree + 1]):
        light[d] = 1.0 / inertia[d]
    for k in range(joint_rows):
        entry = w.Y[k * stride + dof_of(w, k) - first]
        w.row_stiffness[k] = inertia[dof_of(w, k)] / (entry * entry)
    for j in range(contacts):
        contact = w.index[j]
        k = w.contact_row[contact]
        lightness = 0.0
        for row in range(k, k + (3 if w.mu[k] > 0.0 else 1)):
            total = 0.0
            d = w.body_last_dof[w.contact_body[contact]]
            while d >= 0:
                entry = w.Y[row * stride + d - first]
                total += entry * entry * light[d]
                d = w.dof_parent[d]
            lightness = max(lightness, total)
        w.row_stiffness[k] = 1.0 / lightness if lightness > 0.0 else 0.0
        if w.before[k] > 0.0 and abs(w.row_bias[k]) <= LEFT:
            w.row_bias[k] = 0.0


@compiled
def row_velocities(
    w: KernelWorld, tree: int, stride: int, joint_rows: int, contacts: int, x: Any, share: float, into: Any
) -> None:
    """Write the velocities of all rows at the velocities x of the dofs, and this share of their biases."""
    move_bodies(w, tree, x)
    first = w.tree_dof[tree]
    for k in range(joint_rows):
        d = dof_of(w, k)
        into[k] = w.Y[k * stride + d - first] * x[d] + share * w.row_bias[k]
    for j in range(contacts):
        contact = w.index[j]
        k = w.contact_row[contact]
        twist = load_spatial(w.reach, w.contact_body[contact])
        velocity = add(twist[0], cross(twist[1], load_vector(w.contact_point, contact)))
        into[k] = dot(load_vector(w.contact_frame, 3 * contact + 2), velocity) + share * w.row_bias[k]
        if w.mu[k] > 0.0:
            into[k + 1] = dot(load_vector(w.contact_frame, 3 * contact), velocity) + share * w.row_bias[k + 1]
            into[k + 2] = dot(load_vector(w.contact_frame, 3 * contact + 1), velocity) + share * w.row_bias[k + 2]


@inlined
def load_contact(w: KernelWorld, contact: int, normal: float, first: float, second: float) -> None:
    """Add the impulses of a contact to the wrench on its body."""
    force = add(
        scale(normal, load_vector(w.contact_frame, 3 * contact + 2)),
        add(
            scale(first, load_vector(w.contact_frame, 3 * contact)),
            scale(second, load_vector(w.contact_frame, 3 * contact + 1)),
        ),
    )
    body = w.contact_body[contact]
    wrench = (force, cross(load_vector(w.contact_point, contact), force))
    store_spatial(w.load, body, spatial_add(load_spatial(w.load, body), wrench))


@compiled
def imbalance(
    w: KernelWorld, tree: int, stride: int, joint_rows: int, contacts: int, hardness: float, share: float, bounded: bool
) -> float:
    """Find what all rows exert at a share of the step, and write Jᵀ·P - M·(v - v*) into ``block_f``.

    Where friction is `bounded`, its circle is that of the normal impulse x before the round.

    Returns:
        Its square, in the metric of M⁻¹.
    """
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    rest = w.block_f
    for body in range(w.tree_body[tree], w.tree_body[tree + 1]):
        store_spatial(w.load, body, (ZERO, ZERO))
    for d in range(first, beyond):
        rest[d] = -(w.sum_s[d] + share * w.slope_s[d])
    for k in range(joint_rows):
        d = dof_of(w, k)
        z = w.x[k] - hardness * w.row_stiffness[k] * (w.y[k] + share * w.velocity[k])
        w.ahead[k] = min(w.high[k], max(w.low[k], z))
        rest[d] += w.Y[k * stride + d - first] * w.ahead[k]
    for j in range(contacts):
        contact = w.index[j]
        k = w.contact_row[contact]
        penalty = hardness * w.row_stiffness[k]
        normal = max(0.0, w.x[k] - penalty * (w.y[k] + share * w.velocity[k]))
        a = b = most = 0.0
        if w.mu[k] > 0.0:
            most = w.mu[k] * (w.x[k] if bounded else normal)
            if most > 0.0:
                a = w.x[k + 1] - penalty * (w.y[k + 1] + share * w.velocity[k + 1])
                b = w.x[k + 2] - penalty * (w.y[k + 2] + share * w.velocity[k + 2])
                size = math.sqrt(a * a + b * b)
                if size > most:
                    a, b = a * most / size, b * most / size
            w.ahead[k + 1], w.ahead[k + 2] = a, b
        w.ahead[k] = normal
        if normal > 0.0 or most > 0.0:
            load_contact(w, contact, normal, a, b)
    gather_loads(w, tree, rest)
    for d in range(first, beyond):
        w.u[d] = rest[d]
    solve_transposed(w, first, beyond, w.u, 0)
    total = 0.0
    for d in range(first, beyond):
        total += w.u[d] * w.u[d]
    return total


@inlined
def forget_matrix(w: KernelWorld) -> None:
    """Let `matrix_changes` find that the matrix changes."""
    w.state[0] = UNKNOWN


@inlined
def set_state(w: KernelWorld, k: int, state: int) -> bool:
    """Write the state of a row or contact; return whether it differs from the one before."""
    changed = w.state[k] != state
    w.state[k] = state
    return bool(changed)


@compiled
def matrix_changes(w: KernelWorld, joint_rows: int, contacts: int, hardness: float, bounded: bool) -> bool:
    """Write what all rows do at the present velocities; return whether the matrix of `linearise` differs from the last.

    At the same penalty, it depends on this only as long as nothing slides.
    """
    changed = False
    for k in range(joint_rows):
        z = w.x[k] - hardness * w.row_stiffness[k] * w.y[k]
        changed = set_state(w, k, STICKS if w.low[k] < z < w.high[k] else 0) or changed
    for j in range(contacts):
        k = w.contact_row[w.index[j]]
        penalty = hardness * w.row_stiffness[k]
        z = w.x[k] - penalty * w.y[k]
        state = PRESSES if z > 0.0 else 0
        most = w.mu[k] * (w.x[k] if bounded else z)
        if most > 0.0:
            a, b = w.x[k + 1] - penalty * w.y[k + 1], w.x[k + 2] - penalty * w.y[k + 2]
            slides = not math.sqrt(a * a + b * b) <= most
            state += SLIPS if slides else STICKS
            changed = changed or slides
        changed = set_state(w, k, state) or changed
    return changed


@compiled
def linearise(
    w: KernelWorld,
    tree: int,
    stride: int,
    joint_rows: int,
    contacts: int,
    hardness: float,
    inertia: Any,
    bounded: bool,
) -> None:
    """Write the derivative of M·v - Jᵀ·P into K, of what rows do after `matrix_changes`; see `imbalance`."""
    first = w.tree_dof[tree]
    for k in range(36 * w.tree_body[tree], 36 * w.tree_body[tree + 1]):
        w.push[k] = 0.0
    for j in range(contacts):
        contact = w.index[j]
        k = w.contact_row[contact]
        state = w.state[k]
        if state == 0:
            continue
        penalty = hardness * w.row_stiffness[k]
        body, normal = w.contact_body[contact], direction(w, contact, 2)
        stiff = (scale(penalty, normal[0]), scale(penalty, normal[1]))
        if state & PRESSES != 0 and (bounded or state & SLIPS == 0):
            add_product(w, body, stiff, normal)
        if state == PRESSES:
            continue
        first_way, second_way = direction(w, contact, 0), direction(w, contact, 1)
        if state & SLIPS == 0:
            add_product(w, body, (scale(penalty, first_way[0]), scale(penalty, first_way[1])), first_way)
            add_product(w, body, (scale(penalty, second_way[0]), scale(penalty, second_way[1])), second_way)
            continue
        # Friction grows with the normal impulse, and turns with the slip.
        a, b = w.x[k + 1] - penalty * w.y[k + 1], w.x[k + 2] - penalty * w.y[k + 2]
        size = math.sqrt(a * a + b * b)
        most = w.mu[k] * (w.x[k] if bounded else w.x[k] - penalty * w.y[k])
        a, b = a / size, b / size
        along = (
            add(scale(a, first_way[0]), scale(b, second_way[0])),
            add(scale(a, first_way[1]), scale(b, second_way[1])),
        )
        across = (
            add(scale(a, second_way[0]), scale(-b, first_way[0])),
            add(scale(a, second_way[1]), scale(-b, first_way[1])),
        )
        if not bounded:
            c = penalty * w.mu[k]
            add_product(w, body, (add(stiff[0], scale(c, along[0])), add(stiff[1], scale(c, along[1]))), normal)
        c = penalty * most / size
        add_product(w, body, (scale(c, across[0]), scale(c, across[1])), across)
    assemble_tree(w, tree, inertia)
    for k in range(joint_rows):
        if w.state[k] == STICKS:
            d = dof_of(w, k)
            entry = w.Y[k * stride + d - first]
            w.K_rows[w.dof_branch[d] + w.dof_depth[d]] += hardness * w.row_stiffness[k] * entry * entry
