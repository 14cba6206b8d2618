"""The matrix M + Jᵀ·W·J of an island where contacts slide, in the blocks of `block_matrix`.

Friction grows with the normal impulse, so that W and the matrix are not symmetric. The blocks on and above the diagonal
are in B, the blocks below it in A, transposed. Both are then eliminated by the same operations on
rows. Where friction jams a body, pivots may be negative: a step of Newton's method only needs the matrix to be regular.
"""

from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.island_solver.block_assembly import add_block
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import load6, store
from urdfkit.sim.engine.simulation_memory import WIDTH
from urdfkit.sim.engine.solver.row_states import HOLDS, SLIDES
from urdfkit.sim.engine.solver.tree_matrix import LEAST_PIVOT


@inlined
def add_product(K: Any, n: int, i: int, j: int, ni: int, nj: int, Y: Any, at: int, to: int, width: int, W: Any) -> None:
    """Add aᵀ·W·b to a block of K, a and b parts of the three rows of a contact."""
    if nj == 6:
        first, second, third = load6(Y, to), load6(Y, to + width), load6(Y, to + 2 * width)
        normal = W[0] * first + W[1] * second + W[2] * third
        one, other = W[3] * first + W[4] * second + W[5] * third, W[6] * first + W[7] * second + W[8] * third
        for k in range(ni):
            here = (i + k) * n + j
            store(
                K, here, load6(K, here) + Y[at + k] * normal + Y[at + width + k] * one + Y[at + 2 * width + k] * other
            )
        return
    for k in range(ni):
        a, b, c = Y[at + k], Y[at + width + k], Y[at + 2 * width + k]
        first = a * W[0] + b * W[3] + c * W[6]
        second = a * W[1] + b * W[4] + c * W[7]
        third = a * W[2] + b * W[5] + c * W[8]
        for m in range(nj):
            K[(i + k) * n + j + m] += first * Y[to + m] + second * Y[to + width + m] + third * Y[to + 2 * width + m]


@inlined
def add_contact(w: KernelWorld, k: int, n: int) -> None:
    """Add the stiffness of a contact that holds, or slides along ``near_x``."""
    width, D = w.sizes[WIDTH], w.g[k]
    slid, slid_too, along, mixed, across = 0.0, 0.0, D, 0.0, D
    if w.state[k] == SLIDES:
        turned, a, b = w.near_x[k], w.near_x[k + 1], w.near_x[k + 2]
        slid, slid_too = -w.mu[k] * D * a, -w.mu[k] * D * b
        along, mixed, across = turned * b * b, -turned * a * b, turned * a * a
    W = (D, 0.0, 0.0, slid, along, mixed, slid_too, mixed, across)
    transposed = (D, slid, slid_too, 0.0, along, mixed, 0.0, mixed, across)
    i, j, ni, nj, at = w.at_a[k], w.at_b[k], w.of_a[k], w.of_b[k], k * width
    to = at + ni
    add_product(w.B, n, i, i, ni, ni, w.Y, at, at, width, W)
    if nj == 0:
        return
    add_product(w.B, n, j, j, nj, nj, w.Y, to, to, width, W)
    if i < j:
        add_product(w.B, n, i, j, ni, nj, w.Y, at, to, width, W)
        add_product(w.A, n, i, j, ni, nj, w.Y, at, to, width, transposed)
    else:
        add_product(w.B, n, j, i, nj, ni, w.Y, to, at, width, W)
        add_product(w.A, n, j, i, nj, ni, w.Y, to, at, width, transposed)


@inlined
def add_row(w: KernelWorld, k: int, n: int) -> None:
    """Add the stiffness of a joint row, or of a contact without friction, that holds."""
    i, j, ni, nj, at = w.at_a[k], w.at_b[k], w.of_a[k], w.of_b[k], k * w.sizes[WIDTH]
    to = at + ni
    add_block(w.B, n, i, i, ni, ni, w.Y, at, at, w.g[k])
    if nj == 0:
        return
    add_block(w.B, n, j, j, nj, nj, w.Y, to, to, w.g[k])
    if i < j:
        add_block(w.B, n, i, j, ni, nj, w.Y, at, to, w.g[k])
        add_block(w.A, n, i, j, ni, nj, w.Y, at, to, w.g[k])
    else:
        add_block(w.B, n, j, i, nj, ni, w.Y, to, at, w.g[k])
        add_block(w.A, n, j, i, nj, ni, w.Y, to, at, w.g[k])


@compiled
def assemble_unsymmetric(w: KernelWorld, root: int, rows: int, n: int, inertia: Any) -> None:
    """Write M, and add the stiffness of the rows; the diagonal of M, with dampers, is `inertia`."""
    above, below = w.B, w.A
    k = 0
    while w.block_first[k] < n:
        for i in range(w.block_first[k] * n, w.block_first[k + 1] * n, n):
            for each in range(w.first_near[k], w.first_near[k + 1]):
                b = w.block_near[each]
                for j in range(i + w.block_first[b], i + w.block_first[b + 1]):
                    above[j] = below[j] = 0.0
        k += 1
    tree = root
    while tree >= 0:
        first, size = w.tree_dof[tree], w.tree_dof[tree + 1] - w.tree_dof[tree]
        at = w.block_first[w.tree_block[tree]]
        for k in range(size):
            row = w.dof_row[first + k] + first
            for j in range(k):
                above[(at + k) * n + at + j] = above[(at + j) * n + at + k] = w.M[row + j]
            above[(at + k) * n + at + k] = inertia[first + k]
        tree = w.island_next[tree]
    k = 0
    while k < rows:
        if w.mu[k] > 0.0:
            if w.state[k] == HOLDS or w.state[k] == SLIDES:
                add_contact(w, k, n)
            k += 3
            continue
        if w.state[k] == HOLDS:
            add_row(w, k, n)
        k += 1


@inlined
def take(X: Any, to: int, c: float, Z: Any, at: int, size: int) -> None:
    """Subtract a multiple of so many numbers of Z from numbers of X."""
    rest = size
    while rest >= 6:
        store(X, to, load6(X, to) - c * load6(Z, at))
        to, at, rest = to + 6, at + 6, rest - 6
    for j in range(rest):
        X[to + j] -= c * Z[at + j]


@inlined
def multiply(X: Any, at: int, c: float, size: int) -> None:
    """Multiply so many numbers of X by a factor."""
    rest = size
    while rest >= 6:
        store(X, at, c * load6(X, at))
        at, rest = at + 6, rest - 6
    for j in range(at, at + rest):
        X[j] *= c


@inlined
def take_six(X: Any, to: int, C: Any, of: int, at: int, n: int) -> None:
    """Subtract from six numbers of X the product of a column of C and six rows of X."""
    rest = load6(X, to) - C[of] * load6(X, at) - C[of + n] * load6(X, at + n) - C[of + 2 * n] * load6(X, at + 2 * n)
    of, at = of + 3 * n, at + 3 * n
    rest = rest - C[of] * load6(X, at) - C[of + n] * load6(X, at + n) - C[of + 2 * n] * load6(X, at + 2 * n)
    store(X, to, rest)


@inlined
def eliminate_block(w: KernelWorld, k: int, n: int) -> bool:
    """Factor a block of the diagonal, and eliminate its rows and columns in its neighbours; return if it is regular."""
    U, L, lightness = w.B, w.A, w.slope_v
    first, beyond = w.block_first[k], w.block_first[k + 1]
    for d in range(first, beyond):
        at = d * n
        if not abs(U[at + d]) * lightness[d] > LEAST_PIVOT:
            return False
        inverse = 1.0 / U[at + d]
        for i in range(d + 1, beyond):
            L[at + i] = U[i * n + d] * inverse
            # Whole rows are quicker; the entries before the diagonal are never used.
            take(U, i * n + first, L[at + i], U, at + first, beyond - first)
        for each in range(w.first_near[k], w.first_near[k + 1]):
            b = w.block_near[each]
            start, size = w.block_first[b], w.block_first[b + 1] - w.block_first[b]
            multiply(L, at + start, inverse, size)
            for i in range(d + 1, beyond):
                take(U, i * n + start, L[at + i], U, at + start, size)
                take(L, i * n + start, U[at + i], L, at + start, size)
        U[at + d] = inverse
    return True


@compiled
def factor_unsymmetric(w: KernelWorld, n: int) -> bool:
    """Factor the matrix block by block, its diagonal inverted; return whether it is regular."""
    U, L = w.B, w.A
    k = 0
    while w.block_first[k] < n:
        first, beyond = w.block_first[k], w.block_first[k + 1]
        if not eliminate_block(w, k, n):
            return False
        for one in range(w.first_near[k], w.first_near[k + 1]):
            b = w.block_near[one]
            for other in range(one, w.first_near[k + 1]):
                e = w.block_near[other]
                start, size = w.block_first[e], w.block_first[e + 1] - w.block_first[e]
                for i in range(w.block_first[b], w.block_first[b + 1]):
                    here, of, at = i * n + start, first * n + i, first * n + start
                    if size == 6 and beyond - first == 6:
                        take_six(U, here, L, of, at, n)
                        if e != b:
                            take_six(L, here, U, of, at, n)
                        continue
                    for _ in range(first, beyond):
                        take(U, here, L[of], U, at, size)
                        if e != b:
                            take(L, here, U[of], L, at, size)
                        of, at = of + n, at + n
        k += 1
    return True


@compiled
def substitute_unsymmetric(w: KernelWorld, n: int, x: Any) -> None:
    """Turn x into K⁻¹·x."""
    U, L = w.B, w.A
    k = 0
    while w.block_first[k] < n:
        first, beyond = w.block_first[k], w.block_first[k + 1]
        for d in range(first, beyond):
            take(x, d + 1, x[d], L, d * n + d + 1, beyond - d - 1)
            for each in range(w.first_near[k], w.first_near[k + 1]):
                b = w.block_near[each]
                start = w.block_first[b]
                take(x, start, x[d], L, d * n + start, w.block_first[b + 1] - start)
        k += 1
    while k > 0:
        k -= 1
        first, beyond = w.block_first[k], w.block_first[k + 1]
        for each in range(w.first_near[k], w.first_near[k + 1]):
            b = w.block_near[each]
            for d in range(first, beyond):
                for j in range(w.block_first[b], w.block_first[b + 1]):
                    x[d] -= U[d * n + j] * x[j]
        for d in range(beyond - 1, first - 1, -1):
            total = x[d]
            for j in range(d + 1, beyond):
                total -= U[d * n + j] * x[j]
            x[d] = total * U[d * n + d]
