"""Islands that are too large for blocks, or that rounds do not come near to: sweeps over their contacts.

One contact after the other gets the impulse that puts it right, all others staying as they are (block Gauss-Seidel,
projected onto the law): held where its cone allows that, or else sliding, or open. Impulses begin with those of the
last step, so that what one step leaves the next continues; what rests is exact after a while. A sweep costs as much
as there are contacts, and there are no more than `SWEEPS`.

Sweeps alone carry a load from one contact to the next. In a tower, a missing impulse at the foot reaches the top some
steps later, and the tower sways for ever as if on springs. Therefore, contacts are swept in their order and back, and
the resulting change of impulses is the gradient of a method of conjugate gradients, see `conjugate_gradient`.

Penetrations that are to be taken back contradict each other where a body lies on more points than it needs: some sweeps
later what could not be taken back is left, or impulses would grow with each sweep.

Sources: M. Jean, Comput. Methods Appl. Mech. Eng. 177 (1999) 235-257 (contact by contact); F. Jourdan, P. Alart, M.
Jean, ibid. 155 (1998) 31-47 (Gauss-Seidel for Coulomb's law).
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_transposed
from urdfkit.sim.engine.island_solver.conjugate_gradient import KEPT, go_further, note
from urdfkit.sim.engine.island_solver.jacobian_products import push_contact, push_row, row_speed
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.simd import load4, store
from urdfkit.sim.engine.simulation_memory import WIDTH

SWEEPS = 60
"""Most sweeps of a step, each way counted."""
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
def delassus_entry(w: KernelWorld, i: int, j: int) -> float:
    """Return the product of two whitened rows of the same trees."""
    width = w.sizes[WIDTH]
    total = 0.0
    for d in range(w.of_a[i] + w.of_b[i]):
        total += w.Y[i * width + d] * w.Y[j * width + d]
    return total


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
        own, at = delassus_entry(w, k, k), KEPT * k // 3
        if w.mu[k] > 0.0:
            ss, tt = delassus_entry(w, k + 1, k + 1), delassus_entry(w, k + 2, k + 2)
            ns, nt = delassus_entry(w, k, k + 1), delassus_entry(w, k, k + 2)
            keep_inverse(w.A, at, own, ss, tt, ns, nt, delassus_entry(w, k + 1, k + 2))
            for d in range(w.of_a[k] + w.of_b[k]):
                to, of = k * width + 3 * d, k * width + d
                w.columns[to], w.columns[to + 1], w.columns[to + 2] = w.Y[of], w.Y[of + width], w.Y[of + 2 * width]
            k += 3
            continue
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
    push_contact(w, k, p - n, q - a, r - b, w.u)
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
def sweep_both_ways(w: KernelWorld, rows: int) -> float:
    """Put all contacts and rows right in their order, then in reverse; return by how much velocities change."""
    moved = 0.0
    for back in range(2):
        k = 0 if back == 0 else rows - 1
        while 0 <= k < rows:
            # Going back, the last row of a contact comes first.
            if back == 1 and k >= 2 and w.mu[k - 2] > 0.0:
                k -= 2
            size = 1
            if w.mu[k] > 0.0:
                moved = max(moved, put_right(w, k))
                size = 3
            else:
                moved = max(moved, put_row_right(w, k))
            k = k + size if back == 0 else k - 1
    return moved


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
    done = 0
    moved = math.inf
    size = 0.0
    while True:
        note(w, root, rows)
        moved = sweep_both_ways(w, rows)
        done += 2
        if done % LEAVE_EVERY == 0:
            leave_unmet(w, rows)
            size = 0.0
        if moved <= STILL or done >= SWEEPS:
            break
        if done % LEAVE_EVERY != 0:
            size = go_further(w, root, rows, size)
    met, brought = work_of(w, rows)
    if met + brought > 0.0:
        # Impulses never bring energy: they are all made smaller, and stay in their cones.
        share = max(0.0, -met / brought)
        for k in range(rows):
            push_row(w, k, (share - 1.0) * w.x[k], w.u)
            w.x[k] *= share
    return done if moved <= STILL else SWEEPS + 1
