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

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
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
MOST_GUESSES = 12
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
def solve_active_set(w: KernelWorld, rows: int, rest: Any, softness: float) -> int:
    """Compute the impulses for the active set in ``state``, with softness relative to the impulses `rest`.

    Returns:
        1, or -1 where contacts slide, `EXACTLY` where they do without softness, and 0 if there are no such impulses.
    """
    x = w.x
    n = 0
    sliding = pushed = False
    k = 0
    while k < rows:
        x[k] = 0.0
        if w.state[k] == HOLDS:
            w.index[n] = k
            n += 1
        elif w.mu[k] > 0.0:
            x[k + 1] = x[k + 2] = 0.0
            if w.state[k] == SLIDES:
                sliding = True
                w.index[n], w.index[n + 1] = k, k + 1
                n += 2
            k += 3
            continue
        else:
            x[k] = w.low[k] if w.state[k] == AT_LOW else w.high[k]
            pushed = True
        k += 1
    if sliding:
        if softness == SOFTNESS and newton_step(w, rows, n, rest):
            return EXACTLY
        soft = max(softness, SLIDING_SOFTNESS)
        return -1 if regularised_newton_step(w, rows, n, rest, soft) else 0
    width = padded(n + 1)
    for a in range(n):
        i = w.index[a]
        total = -w.g[i] + softness * w.A[i * rows + i] * rest[i]
        if pushed:
            for j in range(rows):
                if x[j] != 0.0:
                    total -= w.A[i * rows + j] * x[j]
        if n == rows:
            for first in range(a & -LANES, width, LANES):
                store(w.B, a * width + first, load16(w.A, a * rows + first))
        else:
            for b in range(a, n):
                w.B[a * width + b] = w.A[i * rows + w.index[b]]
        w.B[a * width + a] += softness * w.A[i * rows + i]
        w.B[a * width + n] = total
    if not factor_and_solve(n, w.B, w.y):
        return 0
    for a in range(n):
        x[w.index[a]] = w.y[a]
    return 1


@inlined
def iterate_active_set(w: KernelWorld, rows: int, rest: Any, softness: float, tiny: float, attempts: int) -> int:
    """Revise the active set until it is consistent; return the number of iterations, `attempts` if it never was."""
    for tried in range(attempts):
        found = solve_active_set(w, rows, rest, softness)
        if found == 0:
            break
        there = found > 0 or rotate_slip_directions(w, rows, w.x, tiny)
        if revise_active_set(w, rows, w.x, tiny) and there:
            return tried
    return attempts


@inlined
def gauss_seidel(w: KernelWorld, rows: int, x: Any, sweeps: int, tiny: float) -> float:
    """Improve x by projected Gauss-Seidel sweeps with circular friction cones, until it converges.

    Returns:
        The greatest change of velocity that the last sweep still made.
    """
    moved = math.inf
    for _ in range(sweeps):
        moved = 0.0
        k = 0
        while k < rows:
            stiffness = w.A[k * rows + k]
            old = x[k]
            x[k] = min(w.high[k], max(w.low[k], old - result(rows, w.A, w.g, x, k) / stiffness))
            moved = max(moved, abs(x[k] - old) * stiffness)
            if w.mu[k] > 0.0:
                stiffness = max(w.A[(k + 1) * rows + k + 1], w.A[(k + 2) * rows + k + 2])
                first, second = x[k + 1], x[k + 2]
                a = first - result(rows, w.A, w.g, x, k + 1) / stiffness
                b = second - result(rows, w.A, w.g, x, k + 2) / stiffness
                size, most = math.sqrt(a * a + b * b), w.mu[k] * x[k]
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
def is_implausible(w: KernelWorld, rows: int, x: Any, largest: float) -> bool:
    """Return whether impulses make rows far faster than any row was, which inelastic impacts cannot do.

    A body that is wedged in too little space gets contradictory rows whose impulses grow with every step, and the
    result when one of them is released is not a solution.
    """
    for k in range(rows):  # noqa: SIM110
        if abs(result(rows, w.A, w.g, x, k)) > STRAYING * (largest + 0.1):
            return True
    return False


@inlined
def gains_energy(w: KernelWorld, rows: int, x: Any) -> bool:
    """Return whether impulses do more work than none: x·(A·x/2 + g) > 0."""
    work = 0.0
    for k in range(rows):
        work += 0.5 * x[k] * (result(rows, w.A, w.g, x, k) + w.g[k])
    return work > 0.0


@compiled
def proximal_point(w: KernelWorld, rows: int, tiny: float, large: int) -> int:
    """Compute the impulses by the proximal point method, if the warm start failed; with `large` rows only by sweeps.

    Returns:
        How many guesses it took, negative if it took sweeps too; 0 if x only comes near the law.
    """
    near = w.near_x
    for k in range(rows):
        near[k] = w.before[k]
    tried = 0
    sweeps = 0
    moved = math.inf
    if rows > large:
        sweeps = SWEEPS + 1
        moved = gauss_seidel(w, rows, near, sweeps, tiny)
    while sweeps <= SWEEPS:
        softness, failed = SOFTEST, 0
        active_set_from_impulses(w, rows, near)
        while failed < SOFTENINGS:
            wrong = iterate_active_set(w, rows, near, softness, tiny, MOST_GUESSES)
            tried += wrong + 1
            if wrong == MOST_GUESSES:
                failed += 1
                softness = min(1.0, SOFTENING * softness)
                active_set_from_impulses(w, rows, near)
                continue
            off = 0.0
            for k in range(rows):
                off = max(off, softness * w.A[k * rows + k] * abs(w.x[k] - near[k]))
                near[k] = w.x[k]
            if off < tiny or softness == SLIDING_SOFTNESS:
                return tried if sweeps == 0 else -tried
            softness = max(SLIDING_SOFTNESS, HARDENING * softness)
        sweeps = max(10, 3 * sweeps)
        moved = gauss_seidel(w, rows, near, sweeps, tiny)
    if gains_energy(w, rows, near):
        # From nothing, sweeps only ever take energy away.
        for k in range(rows):
            near[k] = 0.0
        moved = gauss_seidel(w, rows, near, SWEEPS, tiny)
    for k in range(rows):
        w.x[k] = near[k]
    return -max(1, tried) if moved <= NEARLY * tiny else 0


@inlined
def residual_slip(w: KernelWorld, rows: int) -> float:
    """Return how much velocity the softness of sliding guesses lets through [m/s or rad/s], 0 where nothing slides."""
    sliding = False
    off = 0.0
    for k in range(rows):
        sliding = sliding or w.state[k] == SLIDES
    if sliding:
        for k in range(rows):
            if w.state[k] == HOLDS or (w.state[k] == SLIDES and w.mu[k] > 0.0):
                off = max(off, abs(result(rows, w.A, w.g, w.x, k)))
    return off


@inlined
def distribute_redundant_loads(w: KernelWorld, rows: int, tiny: float) -> None:
    """Distribute the load of redundant sliding contacts uniquely, after the proximal point method."""
    for k in range(rows):
        w.near_x[k] = w.x[k]
    for _ in range(POLISHES):
        if solve_active_set(w, rows, w.before, SOFTNESS) != EXACTLY:
            break
        there = rotate_slip_directions(w, rows, w.x, tiny)
        if revise_active_set(w, rows, w.x, tiny) and there:
            return
    for k in range(rows):
        w.x[k] = w.near_x[k]


@inlined
def regularise_tangents(w: KernelWorld, rows: int) -> None:
    """Regularise tangents along which the bodies cannot move, as at a wheel of a robot with a fixed base.

    Their velocity is zero whatever the impulse; the softness keeps A regular and the impulse at zero.
    """
    for k in range(rows):
        if w.mu[k] > 0.0:
            for j in range(k + 1, k + 3):
                if w.A[j * rows + j] < 1e-15 * w.A[k * rows + k]:
                    w.A[j * rows + j] = 1e-9 * w.A[k * rows + k]


@inlined
def guess(w: KernelWorld, rows: int, largest: float, attempts: int) -> int:
    """Find the impulses x by so many guesses of the active set, from the impulses ``before``, which are spent.

    Returns:
        How many guesses it took; 0 if all were in vain.
    """
    near = w.near_x
    tiny = smallest(largest)
    regularise_tangents(w, rows)
    initial_active_set(w, rows, tiny)
    for k in range(rows):
        w.before[k] *= MEMORY
    rest = w.before
    tried = 0
    for _ in range(ROUNDS):
        wrong = iterate_active_set(w, rows, rest, SOFTNESS, tiny, attempts)
        tried += wrong + 1
        if wrong == attempts:
            return 0
        if residual_slip(w, rows) <= CONTRADICTION + tiny:
            break
        rest = near
        for k in range(rows):
            near[k] = w.x[k]
    return 0 if tried > MANY and is_implausible(w, rows, w.x, largest) else tried


@compiled
def iterate(w: KernelWorld, rows: int, largest: float, large: int = LARGE) -> int:
    """Find the impulses x where guesses were in vain, from the impulses that these left in ``before``.

    More than `large` rows are only swept.

    Returns:
        How many guesses it took, negative if it took sweeps too; 0 if x only comes near the law.
    """
    near = w.near_x
    tiny = smallest(largest)
    tried = proximal_point(w, rows, tiny, large)
    if tried != 0:
        distribute_redundant_loads(w, rows, tiny)
    if (tried <= 0 or tried > MANY) and is_implausible(w, rows, w.x, largest):
        for k in range(rows):
            near[k] = 0.0
        gauss_seidel(w, rows, near, SWEEPS, tiny)
        for k in range(rows):
            w.x[k] = near[k]
        return 0
    return tried


@inlined
def smallest(largest: float) -> float:
    """Return the velocity that counts as none, from the largest of a row without impulses [m/s or rad/s]."""
    return 1e-11 * largest + 1e-14


@inlined
def fastest_row(w: KernelWorld, rows: int) -> float:
    """Return the largest velocity of a row without impulses [m/s or rad/s]."""
    largest = 0.0
    for k in range(rows):
        largest = max(largest, abs(w.g[k]))
    return largest


@inlined
def solve(w: KernelWorld, rows: int) -> int:
    """Find the impulses x of all rows from A, g, the bounds, mu and the impulses ``before``, which are spent.

    Returns:
        How many guesses it took, negative if it took sweeps too; 0 if x only comes near the law.
    """
    largest = fastest_row(w, rows)
    tried = guess(w, rows, largest, MOST_GUESSES)
    return tried if tried != 0 else iterate(w, rows, largest)
