"""Delassus matrix A = J·M⁻¹·Jᵀ from rows whitened by the mass matrices, and the effect of impulses."""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_transposed, solve_transposed_rows
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import LANES, load16, store


@inlined
def row_product(w: KernelWorld, i: int, j: int, width: int) -> float:
    """Return the product of two whitened rows; those of different trees meet nowhere."""
    tree_dof, row_a, Y = w.tree_dof, w.row_a, w.Y
    total = 0.0
    a, b = row_a[i], w.row_b[i]
    n = tree_dof[a + 1] - tree_dof[a]
    at, to = i * width, j * width
    if row_a[j] == a:
        for d in range(n):
            total += Y[at + d] * Y[to + d]
    elif w.row_b[j] == a:
        to += tree_dof[row_a[j] + 1] - tree_dof[row_a[j]]
        for d in range(n):
            total += Y[at + d] * Y[to + d]
    if b >= 0:
        at += n
        to = j * width
        m = tree_dof[b + 1] - tree_dof[b]
        if row_a[j] == b:
            for d in range(m):
                total += Y[at + d] * Y[to + d]
        elif w.row_b[j] == b:
            to += tree_dof[row_a[j] + 1] - tree_dof[row_a[j]]
            for d in range(m):
                total += Y[at + d] * Y[to + d]
    return total


@inlined
def column_of(k: int, dofs: int) -> int:
    """Return where in ``columns`` the first entry of row k is, each of so many dofs; its next is `LANES` further."""
    return (k & -LANES) * dofs + (k & (LANES - 1))


@inlined
def whiten_columns(w: KernelWorld, rows: int, first: int, beyond: int, width: int) -> None:
    """Do what `build_delassus` does for the rows of a single tree, `LANES` rows at once, see `column_of`.

    Entries of ``columns`` after the last row are not used.
    """
    columns = w.columns
    n = beyond - first
    for k in range(rows):
        at = column_of(k, n)
        for d in range(n):
            columns[at + d * LANES] = w.Y[k * width + d]
    for start in range(0, rows, LANES):
        at = column_of(start, n)
        free = load16(w.row_bias, start)
        for d in range(n):
            free = free + w.v_start[first + d] * load16(columns, at + d * LANES)
        solve_transposed_rows(w, first, beyond, columns, at)
        for d in range(n):
            free = free + w.u[first + d] * load16(columns, at + d * LANES)
        store(w.g, start, free)
    for k in range(rows):
        one = column_of(k, n)
        for start in range(0, rows, LANES):
            at = column_of(start, n)
            products = columns[one] * load16(columns, at)
            for d in range(1, n):
                products = products + columns[one + d * LANES] * load16(columns, at + d * LANES)
            # What this writes beyond the row is the next one's, which comes later.
            store(w.A, k * rows + start, products)


@inlined
def build_delassus(w: KernelWorld, rows: int, single: int, width: int, alone: bool) -> None:
    """Turn rows J into Y = J·L⁻¹, their biases into velocities g with no impulse, and get A = J·M⁻¹·Jᵀ.

    The velocity with no impulse is v + L⁻¹·u. Most islands are a `single` tree, whose number this is; otherwise it is
    -1.
    """
    if single >= 0:
        first, beyond = w.tree_dof[single], w.tree_dof[single + 1]
        if alone:
            first, beyond = 0, width
        whiten_columns(w, rows, first, beyond, width)
        return
    for k in range(rows):
        free = w.row_bias[k]
        at = k * width
        for side in range(2):
            tree = w.row_a[k] if side == 0 else w.row_b[k]
            if tree < 0:
                continue
            first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
            start = at - first
            for d in range(first, beyond):
                free += w.Y[start + d] * w.v_start[d]
            solve_transposed(w, first, beyond, w.Y, start)
            for d in range(first, beyond):
                free += w.Y[start + d] * w.u[d]
            at += beyond - first
        w.g[k] = free
        for j in range(k + 1):
            total = row_product(w, k, j, width)
            w.A[k * rows + j] = total
            w.A[j * rows + k] = total


@inlined
def apply_impulses(w: KernelWorld, rows: int, single: int, width: int, alone: bool) -> None:
    """Add the effect of the impulses x to u."""
    if single >= 0:
        first, beyond = w.tree_dof[single], w.tree_dof[single + 1]
        if alone:
            first, beyond = 0, width
        columns, n = w.columns, beyond - first
        for start in range(0, rows, LANES):
            many = min(LANES, rows - start)
            for d in range(n):
                at = column_of(start, n) + d * LANES
                total = w.u[first + d]
                for k in range(many):
                    total += columns[at + k] * w.x[start + k]
                w.u[first + d] = total
        return
    for k in range(rows):
        xk = w.x[k]
        at = k * width
        for side in range(2):
            tree = w.row_a[k] if side == 0 else w.row_b[k]
            if tree < 0:
                continue
            first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
            for d in range(first, beyond):
                w.u[d] += w.Y[at - first + d] * xk
            at += beyond - first
