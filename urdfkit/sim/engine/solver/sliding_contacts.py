"""Impulses for a given active set with sliding contacts: one step of Newton's method for Coulomb's law.

The unknowns of a sliding contact are the impulse along its normal, with which friction grows, and the one across its
friction, which turns it.

If more rows hold or slide than the bodies have dofs, some rows are redundant, and the distribution of their load is
undetermined; yet it matters, because friction depends on it. Of all impulses that satisfy the law, the solution is the
one whose change since the last step has no component without effect on the motion: where Z·A = 0, Z·D·(x - rest) = 0,
with D the diagonal of A. These equations replace the redundant rows, so that the load is determined as well as the
motion. The solution is the limit of vanishing softness.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.linear_systems import eliminate_and_solve
from urdfkit.sim.engine.math.simd import LANES, load16, padded, store
from urdfkit.sim.engine.solver.row_states import SLIDES

REDUNDANT = 1e-9
"""Squared relative distance of a row from the span of previous rows, below which it is redundant."""
CONTRADICTION = 5e-9
"""Velocity by which redundant rows may contradict the others [m/s or rad/s].

Four wheels stand on the ground at once, though their radii as written put one of them 1e-12 m off it.
"""


@inlined
def is_slip_unknown(w: KernelWorld, i: int) -> bool:
    """Return whether an unknown is the impulse across a contact's slip."""
    return bool(w.state[i] == SLIDES and w.mu[i] == 0.0)


@inlined
def velocity_row(w: KernelWorld, rows: int, i: int) -> None:
    """Write into ``velocity`` what all impulses do to the velocity of an unknown: of row i, or across its slip."""
    if is_slip_unknown(w, i):
        # From the direction of slip a quarter turn back, so that what pushes there turns friction on.
        first, second = w.slip[i + 1], -w.slip[i]
        for j in range(rows):
            w.velocity[j] = first * w.A[i * rows + j] + second * w.A[(i + 1) * rows + j]
    else:
        # What this writes beyond the rows is not used.
        for j in range(0, rows, LANES):
            store(w.velocity, j, load16(w.A, i * rows + j))


@inlined
def right_hand_side(w: KernelWorld, rows: int, i: int) -> float:
    """Return the velocity that the unknown impulses must cause in one of them."""
    velocity_row(w, rows, i)
    total: float = -w.g[i]
    if is_slip_unknown(w, i):
        total = w.slip[i] * w.g[i + 1] - w.slip[i + 1] * w.g[i]
    for j in range(rows):
        total -= w.velocity[j] * w.x[j]
    return total


@inlined
def equation(w: KernelWorld, rows: int, n: int, a: int, to: int) -> None:
    """Write the effect of the unknowns on the velocity of one of them into B, starting at `to`."""
    velocity_row(w, rows, w.index[a])
    b = 0
    while b < n:
        j = w.index[b]
        if w.state[j] == SLIDES:
            first, second = w.slip[j + 1], w.slip[j + 2]
            w.B[to + b] = w.velocity[j] - w.mu[j] * (w.velocity[j + 1] * first + w.velocity[j + 2] * second)
            w.B[to + b + 1] = w.velocity[j + 1] * second - w.velocity[j + 2] * first
            b += 2
        else:
            w.B[to + b] = w.velocity[j]
            b += 1
    if is_slip_unknown(w, w.index[a]):
        w.B[to + a] += w.slip[w.index[a] - 1]


@compiled
def regularised_newton_step(w: KernelWorld, rows: int, n: int, rest: Any, softness: float) -> bool:
    """Find the impulses of a step of Newton's method; return whether there are any.

    Args:
        w: the world's arrays.
        rows: how many there are.
        n: how many of them are unknowns, in ``index``; their impulses are zero.
        rest: the impulses from which the softness is measured.
        softness: relative to the diagonal of A.
    """
    width = padded(n + 1)
    for a in range(n):
        i = w.index[a]
        w.y[a] = right_hand_side(w, rows, i)
        equation(w, rows, n, a, a * width)
        soft = softness * w.A[i * rows + i]
        w.B[a * width + a] += soft
        if not is_slip_unknown(w, i):
            w.y[a] += soft * rest[i]
    if not eliminate_and_solve(n, w.B, w.y):
        return False
    for a in range(n):
        w.x[w.index[a]] = w.y[a]
    return True


@inlined
def find_redundant(w: KernelWorld, rows: int, n: int) -> None:
    """Mark the unknowns with redundant rows, and write the equations that determine their load into B.

    The Gram matrix of the rows is factored (Cholesky), with inverses on the diagonal, and 0 for redundant rows. Its
    factor is the upper triangle of B.
    """
    # The diagonal before it is factored; later, the coefficients of a redundant row.
    B, whole = w.B, w.row_stiffness
    share = whole
    width = padded(n + 1)
    for a in range(n):
        velocity_row(w, rows, w.index[a])
        for b in range(a, n):
            j = w.index[b]
            B[a * width + b] = w.velocity[j]
            if is_slip_unknown(w, j):
                B[a * width + b] = w.velocity[j] * w.slip[j + 1] - w.velocity[j + 1] * w.slip[j]
        if is_slip_unknown(w, w.index[a]):
            B[a * width + a] += w.slip[w.index[a] - 1]
        whole[a] = B[a * width + a]
    for k in range(n):
        pivot, inverse = B[k * width + k], 0.0
        w.redundant[k] = 1
        if pivot > REDUNDANT * whole[k]:
            w.redundant[k] = 0
            inverse = 1.0 / math.sqrt(pivot)
            for first in range(k & -LANES, width, LANES):
                row = inverse * load16(B, k * width + first)
                store(B, k * width + first, row)
                for i in range(k + 1, min(n, first + LANES)):
                    at = i * width + first
                    store(B, at, load16(B, at) - B[k * width + i] * row)
        B[k * width + k] = inverse
    for a in range(n - 1, -1, -1):
        if w.redundant[a] == 1:
            for b in range(a - 1, -1, -1):
                total = B[b * width + a]
                for k in range(b + 1, a):
                    total -= B[b * width + k] * share[k]
                share[b] = total * B[b * width + b]
            for b in range(n):
                part = -share[b] if b < a else (1.0 if a == b else 0.0)
                B[a * width + b] = part * w.A[w.index[b] * rows + w.index[b]]


@inlined
def equations(w: KernelWorld, rows: int, n: int) -> None:
    """Write the matrix of a step of Newton's method into B, redundant rows replaced by how they share their load."""
    find_redundant(w, rows, n)
    for a in range(n):
        if w.redundant[a] == 0:
            equation(w, rows, n, a, a * padded(n + 1))


@compiled
def newton_step(w: KernelWorld, rows: int, n: int, rest: Any) -> bool:
    """Find the impulses of a step of Newton's method without softness; return whether there are any.

    Where redundant rows contradict the others, no impulses will do. Those found are then so far from `rest`, the way
    that a vanishing softness would send them, that a row lets go.
    """
    for a in range(n):
        w.ahead[a] = right_hand_side(w, rows, w.index[a])
    equations(w, rows, n)
    for a in range(n):
        w.y[a] = w.ahead[a]
        if w.redundant[a] == 1:
            w.y[a] = 0.0
            for b in range(n):
                if not is_slip_unknown(w, w.index[b]):
                    w.y[a] += w.B[a * padded(n + 1) + b] * rest[w.index[b]]
    if not eliminate_and_solve(n, w.B, w.y):
        return False
    contradiction = 0.0
    for a in range(n):
        if w.redundant[a] == 1:
            equation(w, rows, n, a, 0)
            for b in range(n):
                w.ahead[a] -= w.B[b] * w.y[b]
            contradiction = max(contradiction, abs(w.ahead[a]))
        else:
            w.ahead[a] = 0.0
    if contradiction > CONTRADICTION:
        equations(w, rows, n)
        if not eliminate_and_solve(n, w.B, w.ahead) or not move_past_bound(w, n):
            return False
    for a in range(n):
        w.x[w.index[a]] = w.y[a]
    return True


@inlined
def move_past_bound(w: KernelWorld, n: int) -> bool:
    """Change y along ``ahead`` until an impulse has just passed its bound; return whether one does."""
    way, first, bound = math.inf, -1, 0.0
    for a in range(n):
        rate = w.ahead[a]
        end = w.low[w.index[a]] if rate < 0.0 else w.high[w.index[a]]
        if rate != 0.0 and abs(end) < math.inf and max(0.0, (end - w.y[a]) / rate) < way:
            way, first, bound = max(0.0, (end - w.y[a]) / rate), a, end
    if first < 0:
        return False
    for a in range(n):
        w.y[a] += way * w.ahead[a]
    beyond = 1e-12 * (1.0 + abs(bound))
    w.y[first] = min(w.y[first], bound - beyond) if w.ahead[first] < 0.0 else max(w.y[first], bound + beyond)
    return True
