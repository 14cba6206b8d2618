"""Impulses for a given active set with sliding contacts: one step of Newton's method for Coulomb's law.

The unknowns of a sliding contact are the impulse along its normal, with which friction grows, and the one across its
friction, which turns it.

If more rows hold or slide than the bodies have dofs, some rows are redundant, and the distribution of their load is
undetermined; yet it matters, because friction depends on it. Of all impulses that satisfy the law, the solution is the
one whose change since the last step has no component without effect on the motion: where Z·A = 0, Z·D·(x - rest) = 0,
with D the diagonal of A. These equations replace the redundant rows, so that the load is determined as well as the
motion. The solution is the limit of vanishing softness.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.math.linear_systems import eliminate_and_solve
from urdfkit.sim.engine.solver.row_states import SLIDES

REDUNDANT = 1e-9
"""Squared relative distance of a row from the span of previous rows, below which it is redundant."""
CONTRADICTION = 5e-9
"""Velocity by which redundant rows may contradict the others [m/s or rad/s].

Four wheels stand on the ground at once, though their radii as written put one of them 1e-12 m off it.
"""


@inlined
def is_slip_unknown(floats: Any, integers: Any, i: int) -> bool:
    """Return whether an unknown is the impulse across a contact's slip."""
    mu = field(floats, integers, At.mu)
    state = field(integers, integers, At.state)
    return bool(state[i] == SLIDES and mu[i] == 0.0)


@inlined
def velocity_row(floats: Any, integers: Any, rows: int, i: int) -> None:
    """Write into ``velocity`` what all impulses do to the velocity of an unknown: of row i, or across its slip."""
    A = field(floats, integers, At.A)
    slip = field(floats, integers, At.slip)
    velocity = field(floats, integers, At.velocity)
    if is_slip_unknown(floats, integers, i):
        # From the direction of slip a quarter turn back, so that what pushes there turns friction on.
        first, second = slip[i + 1], -slip[i]
        for j in range(rows):
            velocity[j] = first * A[i * rows + j] + second * A[(i + 1) * rows + j]
    else:
        for j in range(rows):
            velocity[j] = A[i * rows + j]


@inlined
def right_hand_side(floats: Any, integers: Any, rows: int, i: int) -> float:
    """Return the velocity that the unknown impulses must cause in one of them."""
    g = field(floats, integers, At.g)
    slip = field(floats, integers, At.slip)
    x = field(floats, integers, At.x)
    velocity = field(floats, integers, At.velocity)
    velocity_row(floats, integers, rows, i)
    total: float = -g[i]
    if is_slip_unknown(floats, integers, i):
        total = slip[i] * g[i + 1] - slip[i + 1] * g[i]
    for j in range(rows):
        total -= velocity[j] * x[j]
    return total


@inlined
def equation(floats: Any, integers: Any, rows: int, n: int, a: int, to: int) -> None:
    """Write the effect of the unknowns on the velocity of one of them into B, starting at `to`."""
    B = field(floats, integers, At.B)
    mu = field(floats, integers, At.mu)
    slip = field(floats, integers, At.slip)
    velocity = field(floats, integers, At.velocity)
    state = field(integers, integers, At.state)
    index = field(integers, integers, At.index)
    velocity_row(floats, integers, rows, index[a])
    b = 0
    while b < n:
        j = index[b]
        if state[j] == SLIDES:
            first, second = slip[j + 1], slip[j + 2]
            B[to + b] = velocity[j] - mu[j] * (velocity[j + 1] * first + velocity[j + 2] * second)
            B[to + b + 1] = velocity[j + 1] * second - velocity[j + 2] * first
            b += 2
        else:
            B[to + b] = velocity[j]
            b += 1
    if is_slip_unknown(floats, integers, index[a]):
        B[to + a] += slip[index[a] - 1]


@compiled
def regularised_newton_step(floats: Any, integers: Any, rows: int, n: int, rest: Any, softness: float) -> bool:
    """Find the impulses of a step of Newton's method; return whether there are any.

    Args:
        floats: block of the arrays.
        integers: block of the arrays.
        rows: how many there are.
        n: how many of them are unknowns, in ``index``; their impulses are zero.
        rest: the impulses from which the softness is measured.
        softness: relative to the diagonal of A.
    """
    A = field(floats, integers, At.A)
    B = field(floats, integers, At.B)
    x = field(floats, integers, At.x)
    y = field(floats, integers, At.y)
    index = field(integers, integers, At.index)
    for a in range(n):
        i = index[a]
        y[a] = right_hand_side(floats, integers, rows, i)
        equation(floats, integers, rows, n, a, a * n)
        soft = softness * A[i * rows + i]
        B[a * n + a] += soft
        if not is_slip_unknown(floats, integers, i):
            y[a] += soft * rest[i]
    if not eliminate_and_solve(n, B, y):
        return False
    for a in range(n):
        x[index[a]] = y[a]
    return True


@inlined
def find_redundant(floats: Any, integers: Any, rows: int, n: int) -> None:
    """Mark the unknowns with redundant rows, and write the equations that determine their load into B.

    The Gram matrix of the rows is factored (Cholesky), with inverses on the diagonal, and 0 for redundant rows.
    """
    A = field(floats, integers, At.A)
    B = field(floats, integers, At.B)
    slip = field(floats, integers, At.slip)
    velocity = field(floats, integers, At.velocity)
    index = field(integers, integers, At.index)
    redundant = field(integers, integers, At.redundant)
    for a in range(n):
        i = index[a]
        velocity_row(floats, integers, rows, i)
        for b in range(a + 1):
            j = index[b]
            total = velocity[j]
            if is_slip_unknown(floats, integers, j):
                total = velocity[j] * slip[j + 1] - velocity[j + 1] * slip[j]
                if a == b:
                    total += slip[j - 1]
            whole = total
            for k in range(b):
                total -= B[a * n + k] * B[b * n + k]
            if a > b:
                B[a * n + b] = total * B[b * n + b]
            elif total > REDUNDANT * whole:
                redundant[a] = 0
                B[a * n + a] = 1.0 / math.sqrt(total)
            else:
                redundant[a] = 1
                B[a * n + a] = 0.0
    for a in range(n - 1, -1, -1):
        if redundant[a] == 1:
            for b in range(a - 1, -1, -1):
                total = B[a * n + b]
                for k in range(b + 1, a):
                    total -= B[k * n + b] * B[a * n + k]
                B[a * n + b] = total * B[b * n + b]
            for b in range(n):
                share = -B[a * n + b] if b < a else (1.0 if a == b else 0.0)
                B[a * n + b] = share * A[index[b] * rows + index[b]]


@inlined
def equations(floats: Any, integers: Any, rows: int, n: int) -> None:
    """Write the matrix of a step of Newton's method into B, redundant rows replaced by how they share their load."""
    redundant = field(integers, integers, At.redundant)
    find_redundant(floats, integers, rows, n)
    for a in range(n):
        if redundant[a] == 0:
            equation(floats, integers, rows, n, a, a * n)


@compiled
def newton_step(floats: Any, integers: Any, rows: int, n: int, rest: Any) -> bool:
    """Find the impulses of a step of Newton's method without softness; return whether there are any.

    Where redundant rows contradict the others, no impulses will do. Those found are then so far from `rest`, the way
    that a vanishing softness would send them, that a row lets go.
    """
    B = field(floats, integers, At.B)
    x = field(floats, integers, At.x)
    y = field(floats, integers, At.y)
    ahead = field(floats, integers, At.ahead)
    index = field(integers, integers, At.index)
    redundant = field(integers, integers, At.redundant)
    for a in range(n):
        ahead[a] = right_hand_side(floats, integers, rows, index[a])
    equations(floats, integers, rows, n)
    for a in range(n):
        y[a] = ahead[a]
        if redundant[a] == 1:
            y[a] = 0.0
            for b in range(n):
                if not is_slip_unknown(floats, integers, index[b]):
                    y[a] += B[a * n + b] * rest[index[b]]
    if not eliminate_and_solve(n, B, y):
        return False
    contradiction = 0.0
    for a in range(n):
        if redundant[a] == 1:
            equation(floats, integers, rows, n, a, 0)
            for b in range(n):
                ahead[a] -= B[b] * y[b]
            contradiction = max(contradiction, abs(ahead[a]))
        else:
            ahead[a] = 0.0
    if contradiction > CONTRADICTION:
        equations(floats, integers, rows, n)
        if not eliminate_and_solve(n, B, ahead) or not move_past_bound(floats, integers, n):
            return False
    for a in range(n):
        x[index[a]] = y[a]
    return True


@inlined
def move_past_bound(floats: Any, integers: Any, n: int) -> bool:
    """Change y along ``ahead`` until an impulse has just passed its bound; return whether one does."""
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    y = field(floats, integers, At.y)
    ahead = field(floats, integers, At.ahead)
    index = field(integers, integers, At.index)
    way, first, bound = math.inf, -1, 0.0
    for a in range(n):
        rate = ahead[a]
        end = low[index[a]] if rate < 0.0 else high[index[a]]
        if rate != 0.0 and abs(end) < math.inf and max(0.0, (end - y[a]) / rate) < way:
            way, first, bound = max(0.0, (end - y[a]) / rate), a, end
    if first < 0:
        return False
    for a in range(n):
        y[a] += way * ahead[a]
    beyond = 1e-12 * (1.0 + abs(bound))
    y[first] = min(y[first], bound - beyond) if ahead[first] < 0.0 else max(y[first], bound + beyond)
    return True
