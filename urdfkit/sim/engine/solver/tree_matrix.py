"""Linear algebra along the branches of a tree: J·x, Jᵀ·x and the matrix M + Jᵀ·C·J of its contacts with fixed shapes.

A contact moves with its body, so all contacts of a body act as one stiffness of six by six on its twist, which is
passed on to the parent as inertias are. The matrix K has entries only between dofs of one branch, as M has, and is
factored from the tips to the root without filling in. So the work grows with the dofs, not with the contacts.

``K_rows`` has the row of each dof up to its diagonal, ``K_columns`` its column above. Of both only the entries of the
dofs that carry it are stored, in the order of ``branch``, which lists these from the root on. So entries of two dofs of
one branch for the same dof are at the same place, and eight of them are processed at once.

Source: R. Featherstone, Rigid Body Dynamics Algorithms, 2008, sections 6.2 and 6.5.
"""

from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import STRIP, load6, load8, store
from urdfkit.sim.engine.math.spatial_algebra import (
    ZERO,
    add,
    cross,
    dot,
    load_spatial,
    load_vector,
    scale,
    spatial_add,
    spatial_dot,
    store_spatial,
)

LEAST_PIVOT = 1e-9
"""Ratio of a pivot to the diagonal of M below which the matrix counts as singular."""


@compiled
def move_bodies(w: KernelWorld, tree: int, x: Any) -> None:
    """Write the twists of a tree's bodies at the velocities x of its dofs into ``reach``."""
    for b in range(w.tree_body[tree], w.tree_body[tree + 1]):
        above = w.parent[b]
        twist = load_spatial(w.reach, above) if above >= 0 else (ZERO, ZERO)
        for d in range(w.first_v[b], w.first_v[b + 1]):
            linear, angular = load_spatial(w.S, d)
            twist = (add(twist[0], scale(x[d], linear)), add(twist[1], scale(x[d], angular)))
        store_spatial(w.reach, b, twist)


@compiled
def gather_loads(w: KernelWorld, tree: int, x: Any) -> None:
    """Add the generalised forces of the wrenches ``load`` on a tree's bodies to x; the wrenches are spent."""
    for b in range(w.tree_body[tree + 1] - 1, w.tree_body[tree] - 1, -1):
        load = load_spatial(w.load, b)
        for d in range(w.first_v[b], w.first_v[b + 1]):
            x[d] += spatial_dot(load_spatial(w.S, d), load)
        above = w.parent[b]
        if above >= 0:
            store_spatial(w.load, above, spatial_add(load_spatial(w.load, above), load))


@inlined
def direction(w: KernelWorld, contact: int, axis: int) -> Any:
    """Return the row of a contact along an axis of its frame (two tangents, then the normal), as a wrench of 1 N."""
    along = load_vector(w.contact_frame, 3 * contact + axis)
    return along, cross(load_vector(w.contact_point, contact), along)


@inlined
def add_product(w: KernelWorld, body: int, a: Any, b: Any) -> None:
    """Add a·bᵀ to the stiffness of a body."""
    store_spatial(w.pair, 0, b)
    row = load6(w.pair, 0)
    at = 36 * body
    for k in range(3):
        store(w.push, at + 6 * k, load6(w.push, at + 6 * k) + a[0][k] * row)
        store(w.push, at + 6 * k + 18, load6(w.push, at + 6 * k + 18) + a[1][k] * row)


@compiled
def assemble_tree(w: KernelWorld, tree: int, inertia: Any) -> None:
    """Write M and the stiffness ``push`` of the bodies into K; the diagonal of M, with dampers, is `inertia`."""
    for b in range(w.tree_body[tree + 1] - 1, w.tree_body[tree] - 1, -1):
        at = 36 * b
        if not w.push[at] + w.push[at + 7] + w.push[at + 14] > 0.0:
            # Neither this body nor the bodies that it carries have a contact.
            for d in range(w.first_v[b], w.first_v[b + 1]):
                row, start, depth = w.dof_row[d], w.dof_branch[d], w.dof_depth[d]
                w.K_rows[start + depth] = inertia[d]
                for j in range(start, start + depth):
                    w.K_rows[j] = w.K_columns[j] = w.M[row + w.branch[j]]
            continue
        for d in range(w.first_v[b], w.first_v[b + 1]):
            own = load_spatial(w.S, d)
            # The product with the columns, then with the rows.
            left = (ZERO, ZERO)
            store_spatial(w.pair, 0, left)
            right = load6(w.pair, 0)
            for k in range(3):
                right = right + own[0][k] * load6(w.push, at + 6 * k) + own[1][k] * load6(w.push, at + 6 * k + 18)
            store(w.pair, 0, right)
            behind = load_spatial(w.pair, 0)
            linear = (
                spatial_dot(load_spatial(w.push, 6 * b), own),
                spatial_dot(load_spatial(w.push, 6 * b + 1), own),
                spatial_dot(load_spatial(w.push, 6 * b + 2), own),
            )
            angular = (
                spatial_dot(load_spatial(w.push, 6 * b + 3), own),
                spatial_dot(load_spatial(w.push, 6 * b + 4), own),
                spatial_dot(load_spatial(w.push, 6 * b + 5), own),
            )
            row, start, depth = w.dof_row[d], w.dof_branch[d], w.dof_depth[d]
            w.K_rows[start + depth] = inertia[d] + dot(own[0], linear) + dot(own[1], angular)
            for j in range(start, start + depth):
                other, mass = load_spatial(w.S, w.branch[j]), w.M[row + w.branch[j]]
                w.K_rows[j] = mass + spatial_dot(behind, other)
                w.K_columns[j] = mass + dot(linear, other[0]) + dot(angular, other[1])
        above = w.parent[b]
        if above >= 0:
            to = 36 * above
            for k in range(0, 36, 6):
                store(w.push, to + k, load6(w.push, to + k) + load6(w.push, at + k))


@compiled
def factor_tree(w: KernelWorld, tree: int) -> bool:
    """Factor K in place, from the tips to the root (K is not symmetric); return whether it is regular.

    Pivots may be negative, as where friction jams a body: a step of Newton's method only needs K to be regular.
    """
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    rows, columns = w.K_rows, w.K_columns
    for k in range(beyond - 1, first - 1, -1):
        row, depth = w.dof_branch[k], w.dof_depth[k]
        if not abs(rows[row + depth]) > LEAST_PIVOT * w.M[w.dof_row[k] + k]:
            return False
        inverse = 1.0 / rows[row + depth]
        for m in range(depth - 1, -1, -1):
            above = w.dof_branch[w.branch[row + m]]
            c, e = columns[row + m] * inverse, rows[row + m] * inverse
            # What this writes after the entries of a row is never used.
            for j in range(0, m + 1, STRIP):
                store(rows, above + j, load8(rows, above + j) - c * load8(rows, row + j))
                store(columns, above + j, load8(columns, above + j) - e * load8(columns, row + j))
        for j in range(row, row + depth, STRIP):
            store(columns, j, inverse * load8(columns, j))
        # Numbers that were written one by one are slow to load eight at a time.
        rows[row + depth] = inverse
    return True


@compiled
def solve_tree(w: KernelWorld, tree: int, x: Any) -> None:
    """Turn the entries of x for a tree's dofs into K⁻¹·x, with the factors of K."""
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    for k in range(beyond - 1, first - 1, -1):
        xk, start = x[k], w.dof_branch[k]
        for j in range(start, start + w.dof_depth[k]):
            x[w.branch[j]] -= w.K_columns[j] * xk
    for k in range(first, beyond):
        start, depth = w.dof_branch[k], w.dof_depth[k]
        total = x[k]
        for j in range(start, start + depth):
            total -= w.K_rows[j] * x[w.branch[j]]
        x[k] = total * w.K_rows[start + depth]


@compiled
def multiply_inertia(w: KernelWorld, tree: int, inertia: Any, x: Any, into: Any) -> None:
    """Write M·x into a field; the diagonal of M, with dampers, is `inertia`."""
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        row, start = w.dof_row[d], w.dof_branch[d]
        total, xd = inertia[d] * x[d], x[d]
        for j in range(start, start + w.dof_depth[d]):
            e = w.branch[j]
            total += w.M[row + e] * x[e]
            into[e] += w.M[row + e] * xd
        into[d] = total


@compiled
def damped_inertia(w: KernelWorld, tree: int, into: Any) -> None:
    """Write the diagonal of M, with what dampers and servos add to it, as its factor L has it."""
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        row, start = w.dof_row[d], w.dof_branch[d]
        into[d] = 1.0 / (w.inverse_diagonal[d] * w.inverse_diagonal[d])
        for j in range(start, start + w.dof_depth[d]):
            into[w.branch[j]] += w.L[row + w.branch[j]] * w.L[row + w.branch[j]]
