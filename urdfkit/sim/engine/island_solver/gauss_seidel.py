"""Islands that are too large for blocks, or that rounds do not come near to: sweeps over their contacts.

One contact after the other gets the impulse that puts it right, all others staying as they are (block Gauss-Seidel,
projected onto the law): held where its cone allows that, or else sliding, or open. Impulses begin with those of the
last step, so that what one step leaves the next continues; what rests is exact after a while. A sweep costs as much
as there are contacts, and there are no more than `SWEEPS`.

Sweeps alone carry a load from one contact to the next. In a tower, a missing impulse at the foot reaches the top some
steps later, and the tower sways for ever as if on springs. Therefore, contacts are swept in their order and back, and
the resulting change of impulses is accelerated, see `nesterov_acceleration`.

Penetrations that are to be taken back contradict each other where a body lies on more points than it needs: some sweeps
later what could not be taken back is left, or impulses would grow with each sweep.

Sources: M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235-257 (contact by contact); F. Jourdan, P. Alart, M.
Jean, ibid. 155 (1998) 31-47 (Gauss-Seidel for Coulomb's law).
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_transposed
from urdfkit.sim.engine.island_solver.block_matrix import MOST_TREES
from urdfkit.sim.engine.island_solver.jacobian_products import add_impulse, push_row, row_speed
from urdfkit.sim.engine.island_solver.nesterov_acceleration import KEPT, begin_acceleration, go_further, note
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import load4, store
from urdfkit.sim.engine.simulation_memory import WIDTH

SWEEPS, FEWER = 60, 40
"""Most sweeps of a step, each way counted: of islands of more trees than blocks take, and of others, which get rounds
in other steps."""
LEAVE_EVERY = 10
"""Sweeps after which what could not be taken back of penetrations is left."""
STILL = 1e-9
"""Change of velocity [m/s or rad/s] in a sweep that ends them."""
FLAT = 1e-9
"""Determinant of a contact's 3 x 3 Delassus block, over the product of its diagonal, that counts as singular."""


@inlined
def speed_of(w: KernelWorld, k: int) -> float:
    """Return the velocity of a whitened row with the impulses so far [m/s or rad/s]."""
    return float(w.g[k] + row_speed(w, k, w.u))


@inlined
def squared_length(w: KernelWorld, k: int) -> float:
    """Return the square of a whitened row, which is the inverse of its effective mass."""
    at = k * w.sizes[WIDTH]
    total = 0.0
    for d in range(w.of_a[k] + w.of_b[k]):
        total += w.Y[at + d] * w.Y[at + d]
    return total


@inlined
def delassus_row(w: KernelWorld, k: int, j: int) -> Any:
    """Return the products of the j-th whitened row of a contact with all three, from ``columns``."""
    Z, at = w.columns, k * w.sizes[WIDTH]
    total = Z[at + j] * load4(Z, at)
    for d in range(1, w.of_a[k] + w.of_b[k]):
        total = total + Z[at + 3 * d + j] * load4(Z, at + 3 * d)
    store(w.pair, 0, total)
    return w.pair[0], w.pair[1], w.pair[2]


@inlined
def keep_inverse(A: Any, at: int, a: float, b: float, c: float, d: float, e: float, f: float) -> None:
    """Store the inverse of [[a, d, e], [d, b, f], [e, f, c]], d and e, and the inverse masses of single rows."""
    aa, bb, cc = b * c - f * f, a * c - e * e, a * b - d * d
    determinant = a * aa + d * (e * f - d * c) + e * (d * f - b * e)
    A[at + 6], A[at + 7] = 1.0 / a, 1.0 / max(b, c) if max(b, c) > 0.0 else 0.0
    A[at + 9], A[at + 10] = d, e
    A[at + 11], A[at + 12] = a, max(b, c)
    # Where there is no inverse the rows are taken one by one.
    A[at + 8] = 1.0 if determinant > FLAT * a * b * c else 0.0
    if determinant > FLAT * a * b * c:
        inverse = 1.0 / determinant
        A[at], A[at + 1], A[at + 2] = aa * inverse, bb * inverse, cc * inverse
        A[at + 3], A[at + 4], A[at + 5] = (
            (e * f - d * c) * inverse,
            (d * f - b * e) * inverse,
            (d * e - a * f) * inverse,
        )


@compiled
def prepare(w: KernelWorld, rows: int) -> None:
    """Turn rows J into Y = J·L⁻¹, and write the inverse mass of each contact and row in A, `KEPT` for each contact.

    The three rows of a contact are also in ``columns``, with their entries for a dof next to each other. For each row
    ``at_a``, ``of_a``, ``at_b``, ``of_b`` are where the dofs of its trees start, and how many these are.
    """
    width = w.sizes[WIDTH]
    for k in range(rows):
        free = w.row_bias[k]
        at = k * width
        w.of_a[k] = w.at_b[k] = w.of_b[k] = 0
        for side in range(2):
            tree = w.row_a[k] if side == 0 else w.row_b[k]
            if tree < 0:
                continue
            first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
            for d in range(first, beyond):
                free += w.Y[at - first + d] * w.v_start[d]
            solve_transposed(w, first, beyond, w.Y, at - first)
            at += beyond - first
            if side == 0:
                w.at_a[k], w.of_a[k] = first, beyond - first
            else:
                w.at_b[k], w.of_b[k] = first, beyond - first
        w.g[k] = free
    k = 0
    while k < rows:
        at = KEPT * k // 3
        if w.mu[k] > 0.0:
            for d in range(w.of_a[k] + w.of_b[k]):
                to, of = k * width + 3 * d, k * width + d
                w.columns[to], w.columns[to + 1], w.columns[to + 2] = w.Y[of], w.Y[of + width], w.Y[of + 2 * width]
            nn, ns, nt = delassus_row(w, k, 0)
            _, ss, st = delassus_row(w, k, 1)
            _, _, tt = delassus_row(w, k, 2)
            keep_inverse(w.A, at, nn, ss, tt, ns, nt, st)
            k += 3
            continue
        own = squared_length(w, k)
        w.A[at] = 1.0 / own if own > 0.0 else 0.0
        k += 1


@inlined
def six_columns(Z: Any, at: int, x: Any, first: int) -> Any:
    """Return the product of a contact's rows, as ``columns`` has them, and six numbers; the fourth is no result."""
    even = x[first] * load4(Z, at) + x[first + 2] * load4(Z, at + 6) + x[first + 4] * load4(Z, at + 12)
    odd = x[first + 1] * load4(Z, at + 3) + x[first + 3] * load4(Z, at + 9) + x[first + 5] * load4(Z, at + 15)
    return even + odd


@inlined
def whitened_speeds(w: KernelWorld, k: int) -> Any:
    """Return the velocities of a contact's three rows with the impulses so far [m/s]."""
    Z, u, at, size, more = w.columns, w.u, k * w.sizes[WIDTH], w.of_a[k], w.of_b[k]
    if size == 6 and more == 6:
        total = six_columns(Z, at, u, w.at_a[k]) + six_columns(Z, at + 18, u, w.at_b[k])
    elif size == 6 and more == 0:
        total = six_columns(Z, at, u, w.at_a[k])
    else:
        total = u[w.at_a[k]] * load4(Z, at)
        for d in range(1, size):
            total = total + u[w.at_a[k] + d] * load4(Z, at + 3 * d)
        for d in range(more):
            total = total + u[w.at_b[k] + d] * load4(Z, at + 3 * (size + d))
    store(w.pair, 0, total)
    return w.g[k] + w.pair[0], w.g[k + 1] + w.pair[1], w.g[k + 2] + w.pair[2]


@inlined
def put_right(w: KernelWorld, k: int) -> float:
    """Give a contact the impulse that puts it right where all others stay; return by how much velocities change."""
    x, A = w.x, w.A
    at = KEPT * k // 3
    n, a, b = x[k], x[k + 1], x[k + 2]
    off, s, t = whitened_speeds(w, k)
    if n == 0.0 and off >= 0.0:
        return 0.0
    holds = False
    if A[at + 8] > 0.0:
        p = n - A[at] * off - A[at + 3] * s - A[at + 4] * t
        q = a - A[at + 3] * off - A[at + 1] * s - A[at + 5] * t
        r = b - A[at + 4] * off - A[at + 5] * s - A[at + 2] * t
        holds = q * q + r * r <= w.mu[k] * w.mu[k] * p * p and p > 0.0
        moved = max(abs(off), max(abs(s), abs(t)))
    if not holds:
        p = max(0.0, n - A[at + 6] * off)
        q = r = 0.0
        if p > 0.0:
            # With the new normal impulse.
            q = a - A[at + 7] * (s + A[at + 9] * (p - n))
            r = b - A[at + 7] * (t + A[at + 10] * (p - n))
            size, most = math.sqrt(q * q + r * r), w.mu[k] * p
            if size > most:
                most /= size
                q, r = q * most, r * most
        moved = max(A[at + 11] * abs(p - n), A[at + 12] * max(abs(q - a), abs(r - b)))
    x[k], x[k + 1], x[k + 2] = p, q, r
    add_impulse(w, k, p - n, q - a, r - b, w.u)
    return float(moved)


@inlined
def leave_unmet(w: KernelWorld, rows: int) -> None:
    """Limit the corrections of penetrations by the current velocities."""
    for k in range(rows):
        if w.low[k] == 0.0 and w.high[k] == math.inf and w.row_bias[k] < 0.0:
            off = speed_of(w, k)
            if off < 0.0:
                taken = min(-off, -w.row_bias[k])
                w.g[k] += taken
                w.row_bias[k] += taken


@inlined
def work_of(w: KernelWorld, rows: int) -> Any:
    """Return the power that impulses meet before them, x·g, and the energy that they bring by themselves, x·A·x/2."""
    met = brought = 0.0
    for k in range(rows):
        met += w.x[k] * w.y[k]
        brought += 0.5 * w.x[k] * (speed_of(w, k) - w.y[k])
    return met, brought


@inlined
def put_row_right(w: KernelWorld, k: int) -> float:
    """Give a row that is no contact's with friction the impulse that puts it right; return by how much it changes."""
    inverse = w.A[KEPT * k // 3]
    if inverse <= 0.0:
        return 0.0
    old = w.x[k]
    w.x[k] = min(w.high[k], max(w.low[k], old - inverse * speed_of(w, k)))
    push_row(w, k, w.x[k] - old, w.u)
    return float(abs(w.x[k] - old) / inverse)


@compiled
def interleave(w: KernelWorld, rows: int) -> int:
    """List the contacts and single rows in ``index``, each by its first row; return how many there are.

    The processor visits a contact while the one before it is not finished, unless both move the same body. Therefore,
    the contacts between two trees do not follow each other.
    """
    rank, order = w.redundant, w.index
    most = last = k = 0
    while k < rows:
        same = k > 0 and w.row_a[k] == w.row_a[last] and w.row_b[k] == w.row_b[last]
        rank[k] = rank[last] + 1 if same else 0
        most = max(most, rank[k])
        last = k
        k += 3 if w.mu[k] > 0.0 else 1
    count = 0
    for each in range(most + 1):
        k = 0
        while k < rows:
            if rank[k] == each:
                order[count] = k
                count += 1
            k += 3 if w.mu[k] > 0.0 else 1
    return count


@compiled
def sweep_both_ways(w: KernelWorld, count: int) -> float:
    """Correct all contacts and rows in the order of `interleave`, then in reverse; return the change of velocities."""
    moved = 0.0
    for i in range(1 - count, count):
        k = w.index[count - 1 - abs(i)]
        moved = max(moved, put_right(w, k) if w.mu[k] > 0.0 else put_row_right(w, k))
    return moved


@inlined
def most_sweeps(w: KernelWorld, root: int) -> int:
    """Return how many sweeps an island gets at most."""
    trees, tree = 0, root
    while tree >= 0:
        trees, tree = trees + 1, w.island_next[tree]
    return SWEEPS if trees > MOST_TREES else FEWER


@compiled
def sweep(w: KernelWorld, root: int, rows: int) -> int:
    """Find the impulses x of an island as nearly as some sweeps do, and add to u what they do.

    Of the rows Y is J, and becomes whitened; of the trees u is what `smooth_motion` left there.

    Returns:
        How many sweeps it took; one more than the most where more would have changed something.
    """
    prepare(w, rows)
    for k in range(rows):
        w.y[k] = speed_of(w, k)
    for k in range(rows):
        w.x[k] = w.before[k]
        push_row(w, k, w.x[k], w.u)
    begin_acceleration(w, root, rows)
    count, most = interleave(w, rows), most_sweeps(w, root)
    done = 0
    moved = math.inf
    momentum = 1.0
    while True:
        note(w, rows)
        moved = sweep_both_ways(w, count)
        done += 2
        if done % LEAVE_EVERY == 0:
            leave_unmet(w, rows)
        if moved <= STILL or done >= most:
            break
        momentum = go_further(w, root, rows, momentum)
    met, brought = work_of(w, rows)
    if met + brought > 0.0:
        # Impulses never bring energy: they are all made smaller, and stay in their cones.
        share = max(0.0, -met / brought)
        for k in range(rows):
            push_row(w, k, (share - 1.0) * w.x[k], w.u)
            w.x[k] *= share
    return done if moved <= STILL else most + 1
