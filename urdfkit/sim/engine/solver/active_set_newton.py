"""Direct solver for the impulses of all rows: Newton's method on the active set of rows and the slip directions.

The law: with w = A·x + g, a row has low ≤ x ≤ high, and w is zero unless x is at a bound, w ≥ 0 at the lower and w ≤ 0
at the upper one. A contact with friction has x ≥ 0 along its normal and tangential impulses inside the circle of radius
mu·x; where it slips they lie on the circle, against the slip (Coulomb). Impacts are perfectly inelastic.

For a given active set, that is the rows that hold and the contacts that slide, the law is a system of equations that is
linear except for the slip directions. Each iteration is one step of Newton's method, with a warm start from the
impulses of the last step. If the active sets cycle, a sequence of regularised problems is solved, each relative to the
impulses of the previous one (proximal point method). If that fails, projected Gauss-Seidel provides the initial guess.

Sources: P. Alart and A. Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353-375: contact with friction as one
system of equations for Newton's method. R. T. Rockafellar, SIAM J. Control Optim. 14 (1976) 877-898: proximal point.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.math.linear_systems import factor_and_solve
from urdfkit.sim.engine.math.simd import LANES, load16, padded, store
from urdfkit.sim.engine.solver.row_states import (
    AT_LOW,
    HOLDS,
    SLIDES,
    active_set_from_impulses,
    initial_active_set,
    result,
    revise_active_set,
    rotate_slip_directions,
)
from urdfkit.sim.engine.solver.sliding_contacts import CONTRADICTION, newton_step, regularised_newton_step

SOFTNESS = 1e-9
"""Diagonal added to A, relative to it: it shares a load among redundant contacts."""
SLIDING_SOFTNESS = 1e-6
"""The same where contacts slide: there the way a load is shared moves the bodies, so rounding must not decide on it."""
ROUNDS = 6
"""Most solutions for a softness that each starts from the one before, so that none of it is left in the law."""
MEMORY = 0.999
"""How much of the last step's impulse the softness is measured from: a load that stays lets nothing creep."""
POLISHES = 6
"""Most steps of Newton's method from the result of softer problems to what redundant contacts share their load as."""
EXACTLY = -2
"""What `solve_active_set` returns for contacts that slide without softness."""
ATTEMPTS = 12
"""Maximum number of active sets for one softness."""
SOFTEST = 1e-2
"""Softness of the first regularised problem."""
HARDENING = 0.1
"""Ratio of the softness of a problem to the one solved before."""
SOFTENING = 100.0
"""Factor of the softness after a problem that was not solved."""
SOFTENINGS = 3
"""Problems not solved before sweeps help."""
SWEEPS = 400
"""Most sweeps at a time."""
STRAYING = 10.0
"""Ratio of a row's velocity after the impulses to the largest before that is taken for a mistake."""
MANY = 6
"""Number of iterations beyond which the result is checked."""
NEARLY = 100.0
"""Ratio of the last sweep's change to the tolerance up to which sweeps count as converged."""
LARGE = 60
"""Rows beyond which sweeps cost less than softer problems, each a matrix to eliminate several times."""


@inlined
def solve_active_set(floats: Any, integers: Any, rows: int, rest: Any, softness: float) -> int:
    """Compute the impulses for the active set in ``state``, with softness relative to the impulses `rest`.

    Returns:
        1, or -1 where contacts slide, `EXACTLY` where they do without softness, and 0 if there are no such impulses.
    """
    A = field(floats, integers, At.A)
    B = field(floats, integers, At.B)
    g = field(floats, integers, At.g)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    y = field(floats, integers, At.y)
    state = field(integers, integers, At.state)
    index = field(integers, integers, At.index)
    n = 0
    sliding = pushed = False
    k = 0
    while k < rows:
        x[k] = 0.0
        if state[k] == HOLDS:
            index[n] = k
            n += 1
        elif mu[k] > 0.0:
            x[k + 1] = x[k + 2] = 0.0
            if state[k] == SLIDES:
                sliding = True
                index[n], index[n + 1] = k, k + 1
                n += 2
            k += 3
            continue
        else:
            x[k] = low[k] if state[k] == AT_LOW else high[k]
            pushed = True
        k += 1
    if sliding:
        if softness == SOFTNESS and newton_step(floats, integers, rows, n, rest):
            return EXACTLY
        soft = max(softness, SLIDING_SOFTNESS)
        return -1 if regularised_newton_step(floats, integers, rows, n, rest, soft) else 0
    width = padded(n + 1)
    for a in range(n):
        i = index[a]
        total = -g[i] + softness * A[i * rows + i] * rest[i]
        if pushed:
            for j in range(rows):
                if x[j] != 0.0:
                    total -= A[i * rows + j] * x[j]
        if n == rows:
            for first in range(a & -LANES, width, LANES):
                store(B, a * width + first, load16(A, a * rows + first))
        else:
            for b in range(a, n):
                B[a * width + b] = A[i * rows + index[b]]
        B[a * width + a] += softness * A[i * rows + i]
        B[a * width + n] = total
    if not factor_and_solve(n, B, y):
        return 0
    for a in range(n):
        x[index[a]] = y[a]
    return 1


@inlined
def iterate_active_set(floats: Any, integers: Any, rows: int, rest: Any, softness: float, tiny: float) -> int:
    """Revise the active set until it is consistent; return the number of iterations."""
    x = field(floats, integers, At.x)
    for tried in range(ATTEMPTS):
        found = solve_active_set(floats, integers, rows, rest, softness)
        if found == 0:
            break
        there = found > 0 or rotate_slip_directions(floats, integers, rows, x, tiny)
        if revise_active_set(floats, integers, rows, x, tiny) and there:
            return tried
    return ATTEMPTS


@inlined
def gauss_seidel(floats: Any, integers: Any, rows: int, x: Any, sweeps: int, tiny: float) -> float:
    """Improve x by projected Gauss-Seidel sweeps with circular friction cones, until it converges.

    Returns:
        The greatest change of velocity that the last sweep still made.
    """
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    moved = math.inf
    for _ in range(sweeps):
        moved = 0.0
        k = 0
        while k < rows:
            stiffness = A[k * rows + k]
            old = x[k]
            x[k] = min(high[k], max(low[k], old - result(rows, A, g, x, k) / stiffness))
            moved = max(moved, abs(x[k] - old) * stiffness)
            if mu[k] > 0.0:
                stiffness = max(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
                first, second = x[k + 1], x[k + 2]
                a = first - result(rows, A, g, x, k + 1) / stiffness
                b = second - result(rows, A, g, x, k + 2) / stiffness
                size, most = math.sqrt(a * a + b * b), mu[k] * x[k]
                if size > most:
                    a, b = a * most / size, b * most / size
                x[k + 1], x[k + 2] = a, b
                moved = max(moved, (abs(a - first) + abs(b - second)) * stiffness)
                k += 3
            else:
                k += 1
        if moved < tiny:
            break
    return moved


@inlined
def is_implausible(floats: Any, integers: Any, rows: int, x: Any, largest: float) -> bool:
    """Return whether impulses make rows far faster than any row was, which inelastic impacts cannot do.

    A body that is wedged in too little space gets contradictory rows whose impulses grow with every step, and the
    result when one of them is released is not a solution.
    """
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    for k in range(rows):  # noqa: SIM110
        if abs(result(rows, A, g, x, k)) > STRAYING * (largest + 0.1):
            return True
    return False


@inlined
def gains_energy(floats: Any, integers: Any, rows: int, x: Any) -> bool:
    """Return whether impulses do more work than none: x·(A·x/2 + g) > 0."""
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    work = 0.0
    for k in range(rows):
        work += 0.5 * x[k] * (result(rows, A, g, x, k) + g[k])
    return work > 0.0


@compiled
def proximal_point(floats: Any, integers: Any, rows: int, tiny: float) -> int:
    """Compute the impulses by the proximal point method, if the warm start failed.

    Returns:
        How many guesses it took, negative if it took sweeps too; 0 if x only comes near the law.
    """
    A = field(floats, integers, At.A)
    x = field(floats, integers, At.x)
    near = field(floats, integers, At.near_x)
    before = field(floats, integers, At.before)
    for k in range(rows):
        near[k] = before[k]
    tried = 0
    sweeps = 0
    moved = math.inf
    if rows > LARGE:
        sweeps = SWEEPS + 1
        moved = gauss_seidel(floats, integers, rows, near, sweeps, tiny)
    while sweeps <= SWEEPS:
        softness, failed = SOFTEST, 0
        active_set_from_impulses(floats, integers, rows, near)
        while failed < SOFTENINGS:
            wrong = iterate_active_set(floats, integers, rows, near, softness, tiny)
            tried += wrong + 1
            if wrong == ATTEMPTS:
                failed += 1
                softness = min(1.0, SOFTENING * softness)
                active_set_from_impulses(floats, integers, rows, near)
                continue
            off = 0.0
            for k in range(rows):
                off = max(off, softness * A[k * rows + k] * abs(x[k] - near[k]))
                near[k] = x[k]
            if off < tiny or softness == SLIDING_SOFTNESS:
                return tried if sweeps == 0 else -tried
            softness = max(SLIDING_SOFTNESS, HARDENING * softness)
        sweeps = max(10, 3 * sweeps)
        moved = gauss_seidel(floats, integers, rows, near, sweeps, tiny)
    if gains_energy(floats, integers, rows, near):
        # From nothing, sweeps only ever take energy away.
        for k in range(rows):
            near[k] = 0.0
        moved = gauss_seidel(floats, integers, rows, near, SWEEPS, tiny)
    for k in range(rows):
        x[k] = near[k]
    return -max(1, tried) if moved <= NEARLY * tiny else 0


@inlined
def residual_slip(floats: Any, integers: Any, rows: int) -> float:
    """Return how much velocity the softness of sliding guesses lets through [m/s or rad/s], 0 where nothing slides."""
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    x = field(floats, integers, At.x)
    mu = field(floats, integers, At.mu)
    state = field(integers, integers, At.state)
    sliding = False
    off = 0.0
    for k in range(rows):
        sliding = sliding or state[k] == SLIDES
    if sliding:
        for k in range(rows):
            if state[k] == HOLDS or (state[k] == SLIDES and mu[k] > 0.0):
                off = max(off, abs(result(rows, A, g, x, k)))
    return off


@inlined
def distribute_redundant_loads(floats: Any, integers: Any, rows: int, tiny: float) -> None:
    """Distribute the load of redundant sliding contacts uniquely, after the proximal point method."""
    x = field(floats, integers, At.x)
    near = field(floats, integers, At.near_x)
    before = field(floats, integers, At.before)
    for k in range(rows):
        near[k] = x[k]
    for _ in range(POLISHES):
        if solve_active_set(floats, integers, rows, before, SOFTNESS) != EXACTLY:
            break
        there = rotate_slip_directions(floats, integers, rows, x, tiny)
        if revise_active_set(floats, integers, rows, x, tiny) and there:
            return
    for k in range(rows):
        x[k] = near[k]


@inlined
def regularise_tangents(floats: Any, integers: Any, rows: int) -> None:
    """Regularise tangents along which the bodies cannot move, as at a wheel of a robot with a fixed base.

    Their velocity is zero whatever the impulse; the softness keeps A regular and the impulse at zero.
    """
    A = field(floats, integers, At.A)
    mu = field(floats, integers, At.mu)
    for k in range(rows):
        if mu[k] > 0.0:
            for j in range(k + 1, k + 3):
                if A[j * rows + j] < 1e-15 * A[k * rows + k]:
                    A[j * rows + j] = 1e-9 * A[k * rows + k]


@inlined
def solve(floats: Any, integers: Any, rows: int) -> int:
    """Find the impulses x of all rows from A, g, the bounds, mu and the impulses ``before``, which are spent.

    Returns:
        How many guesses it took, negative if it took sweeps too; 0 if x only comes near the law.
    """
    g = field(floats, integers, At.g)
    x = field(floats, integers, At.x)
    near = field(floats, integers, At.near_x)
    before = field(floats, integers, At.before)
    largest = 0.0
    for k in range(rows):
        largest = max(largest, abs(g[k]))
    tiny = 1e-11 * largest + 1e-14
    regularise_tangents(floats, integers, rows)
    initial_active_set(floats, integers, rows, tiny)
    for k in range(rows):
        before[k] *= MEMORY
    rest = before
    tried = 0
    for _ in range(ROUNDS):
        wrong = iterate_active_set(floats, integers, rows, rest, SOFTNESS, tiny)
        tried += wrong + 1
        if wrong == ATTEMPTS:
            tried = proximal_point(floats, integers, rows, tiny)
            if tried != 0:
                distribute_redundant_loads(floats, integers, rows, tiny)
            break
        if residual_slip(floats, integers, rows) <= CONTRADICTION + tiny:
            break
        rest = near
        for k in range(rows):
            near[k] = x[k]
    if (tried <= 0 or tried > MANY) and is_implausible(floats, integers, rows, x, largest):
        for k in range(rows):
            near[k] = 0.0
        gauss_seidel(floats, integers, rows, near, SWEEPS, tiny)
        for k in range(rows):
            x[k] = near[k]
        return 0
    return tried
