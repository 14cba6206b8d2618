"""Islands for which guesses fail: an augmented Lagrangian of Coulomb's law, for the velocities and in blocks.

The method is that of `augmented_newton`: a round finds the velocities at which all rows exert P(x - D·w), P the
projection onto the law, and the next round starts from these impulses with a harder penalty D. Because friction grows
with the normal impulse of the same round, no correction for slip has to settle from round to round, as the convex
problems of `convex_newton` need it. The matrix of a step of Newton's method is not symmetric for the same reason, see
`unsymmetric_matrix`. A few sweeps find most of what rows do before the first round.

A round that does not converge is begun again from the nearest one so far with a softer penalty. Where a harder penalty
gains nothing, rows contradict each other, and penetrations are corrected less.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_forward
from urdfkit.sim.engine.island_solver.augmented_lagrangian import MORE_ROUNDS, OFF
from urdfkit.sim.engine.island_solver.block_matrix import place_rows
from urdfkit.sim.engine.island_solver.convex_newton import limit_corrections
from urdfkit.sim.engine.island_solver.gauss_seidel import interleave, prepare, sweep_both_ways
from urdfkit.sim.engine.island_solver.jacobian_products import push_contact, push_row, row_speeds, take_momentum
from urdfkit.sim.engine.island_solver.nesterov_acceleration import begin_acceleration, go_further, note
from urdfkit.sim.engine.island_solver.unsymmetric_matrix import (
    assemble_unsymmetric,
    factor_unsymmetric,
    substitute_unsymmetric,
)
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import MATRIX, WIDTH
from urdfkit.sim.engine.solver.augmented_newton import BALANCE, EXACT, GAIN, HARDER, NEAR, SOFTER, SOLVED
from urdfkit.sim.engine.solver.row_states import AT_HIGH, AT_LOW, HOLDS, SLIDES

SOFT, SOFTEST, HARDEST = 5e-5, 3e-6, 1e-2
"""Penalties over the stiffness of a held row: of the first round, and the bounds of the others."""
STEPS, TOTAL = 4, 60
"""Most steps of Newton's method in a round, and of all rounds beyond which no other begins, unless rounds converge."""
STUCK = 0.95
"""Ratio of the change in a round to the change before it, from which on rows contradict each other."""
LONG = 20
"""Steps after which velocities that only come near the law are accepted: the convex problems come no nearer, in many
more steps. Most islands take fewer steps."""
FAIR = 3e-4
"""Velocity [m/s or rad/s] that the nearest round may still change if no round comes nearer: convex problems from there
leave 0.2 to 0.8 mm/s, after 250 steps."""
MEMORY = 0.99
"""How much of the last step's impulses is started from."""
SHORTER = (1.0, 0.3, 0.15, 0.075, 0.0375)
"""Shares of a step that are tried; with the shorter ones of a single robot, some piles need more rounds."""
SWEEPS = 10
"""Pairs of sweeps before the first round."""


@inlined
def set_penalty(w: KernelWorld, rows: int, hardness: float) -> None:
    """Set the penalty of each row: the same for the three rows of a contact, that of the lightest."""
    stiffness = w.g
    k = 0
    while k < rows:
        least = w.row_stiffness[k]
        if w.mu[k] > 0.0:
            for j in range(k + 1, k + 3):
                # A tangent along which nothing can move has none.
                if w.row_stiffness[j] > 0.0:
                    least = min(least, w.row_stiffness[j])
            stiffness[k] = stiffness[k + 1] = stiffness[k + 2] = hardness * least
            k += 3
        else:
            stiffness[k] = hardness * least
            k += 1


@inlined
def set_states(w: KernelWorld, rows: int) -> None:
    """Set what all rows do at the current velocities, for the matrix of a step."""
    speeds, stiffness, state, near = w.y, w.g, w.state, w.near_x
    k = 0
    while k < rows:
        D = stiffness[k]
        z = w.x[k] - D * speeds[k]
        if w.mu[k] == 0.0:
            state[k] = AT_LOW if z <= w.low[k] else (AT_HIGH if z >= w.high[k] else HOLDS)
            k += 1
            continue
        a, b = w.x[k + 1] - D * speeds[k + 1], w.x[k + 2] - D * speeds[k + 2]
        size, most = math.sqrt(a * a + b * b), w.mu[k] * z
        state[k] = AT_LOW if z <= 0.0 else (HOLDS if size <= most else SLIDES)
        state[k + 1] = state[k + 2] = state[k]
        if state[k] == SLIDES:
            near[k], near[k + 1], near[k + 2] = D * most / size, -a / size, -b / size
        k += 3


@compiled
def imbalance(w: KernelWorld, rows: int, n: int, share: float) -> float:
    """Find what all rows exert at a share of a step, and write Jᵀ·P - M·v into ``block_f``; return its square.

    The speeds of rows along the step are in ``velocity``, and M times the step in ``sum_v``.
    """
    x, speeds, stiffness, exerted, rest, along = w.x, w.y, w.g, w.ahead, w.block_f, w.velocity
    for d in range(n):
        rest[d] = w.sum_s[d] + share * w.sum_v[d]
    k = 0
    while k < rows:
        D = stiffness[k]
        z = x[k] - D * (speeds[k] + share * along[k])
        if w.mu[k] == 0.0:
            exerted[k] = min(w.high[k], max(w.low[k], z))
            if exerted[k] != 0.0:
                push_row(w, k, exerted[k], rest)
            k += 1
            continue
        a = b = 0.0
        if z > 0.0:
            a = x[k + 1] - D * (speeds[k + 1] + share * along[k + 1])
            b = x[k + 2] - D * (speeds[k + 2] + share * along[k + 2])
            size, most = math.sqrt(a * a + b * b), w.mu[k] * z
            if size > most:
                a, b = a * most / size, b * most / size
            push_contact(w, k, z, a, b, rest)
        exerted[k], exerted[k + 1], exerted[k + 2] = max(0.0, z), a, b
        k += 3
    total = 0.0
    for d in range(n):
        total += rest[d] * rest[d] * w.slope_v[d]
    return total


@compiled
def descend_to_law(w: KernelWorld, root: int, rows: int, n: int, balance: float) -> int:
    """Make steps of Newton's method at a penalty; return how many, negative if the momentum is not balanced then."""
    speed, rest, step, inertia = w.block_v, w.block_f, w.slope_s, w.sum_v
    along = w.velocity
    for k in range(rows):
        along[k] = 0.0
    for d in range(n):
        inertia[d] = 0.0
    here = imbalance(w, rows, n, 0.0)
    for done in range(STEPS + 1):
        largest = off = 0.0
        for k in range(rows):
            largest = max(largest, abs(w.ahead[k]))
        for d in range(n):
            off = max(off, abs(rest[d]))
        if off <= balance * largest:
            return done
        if done == STEPS:
            break
        for d in range(n):
            step[d], inertia[d] = rest[d], 0.0
        set_states(w, rows)
        assemble_unsymmetric(w, root, rows, n, w.u_free)
        if not factor_unsymmetric(w, n):
            return -done - 1
        substitute_unsymmetric(w, n, step)
        take_momentum(w, root, step, inertia)
        row_speeds(w, rows, step, along, 0)
        share = 1.0
        for share in SHORTER:
            now = imbalance(w, rows, n, share)
            if now < here * (1.0 - 0.1 * share):
                break
        here = now
        for d in range(n):
            speed[d] += share * step[d]
            w.sum_s[d] += share * inertia[d]
        for k in range(rows):
            w.y[k] += share * along[k]
    return -STEPS


@inlined
def take_over(w: KernelWorld, rows: int) -> float:
    """Take over the impulses of a round; return the velocity by which they differ from those before it."""
    off = 0.0
    for k in range(rows):
        if w.g[k] > 0.0:
            off = max(off, abs(w.ahead[k] - w.x[k]) / w.g[k])
        w.x[k] = w.ahead[k]
    return off


@inlined
def sweep_first(w: KernelWorld, root: int, rows: int) -> None:
    """Find velocities ``block_v`` and impulses x by sweeps from those of the last step; rows stay as they are."""
    kept, width = w.slope_s, w.sizes[WIDTH]
    for k in range(rows * width):
        w.B[k] = w.Y[k]
    tree = root
    while tree >= 0:
        for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
            # As `smooth_motion` left it, see `hold`.
            kept[d], w.u[d] = w.u[d], w.v_ahead[d]
        tree = w.island_next[tree]
    prepare(w, rows)
    for k in range(rows):
        w.x[k] = MEMORY * w.before[k]
        push_row(w, k, w.x[k], w.u)
    begin_acceleration(w, root, rows)
    count = interleave(w, rows)
    momentum = 1.0
    for done in range(SWEEPS):
        note(w, rows)
        sweep_both_ways(w, count)
        # The last pair of sweeps leaves impulses that the law allows.
        if done < SWEEPS - 1:
            momentum = go_further(w, root, rows, momentum)
    tree = root
    while tree >= 0:
        first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
        solve_forward(w, first, beyond)
        at = w.block_first[w.tree_block[tree]]
        for d in range(first, beyond):
            w.block_v[at + d - first] = w.u[d] - kept[d]
            w.u[d] = kept[d]
        tree = w.island_next[tree]
    for k in range(rows * width):
        w.Y[k] = w.B[k]
    place_rows(w, rows)


@inlined
def begin(w: KernelWorld, root: int, rows: int, n: int) -> None:
    """Compute speeds of rows and momentum at ``block_v``, the metric of `imbalance`, and M's diagonal in ``u_free``."""
    light: Any = w.slope_v
    inertia: Any = w.u_free
    tree = root
    while tree >= 0:
        first, at = w.tree_dof[tree], w.block_first[w.tree_block[tree]]
        for d in range(first, w.tree_dof[tree + 1]):
            light[at + d - first] = 1.0 / w.M[w.dof_row[d] + d]
            # The diagonal of M, with what dampers and servos add to it, as its factor L has it.
            inertia[d] = 1.0 / (w.inverse_diagonal[d] * w.inverse_diagonal[d])
            e = w.dof_parent[d]
            while e >= 0:
                inertia[e] += w.L[w.dof_row[d] + e] * w.L[w.dof_row[d] + e]
                e = w.dof_parent[e]
        tree = w.island_next[tree]
    for d in range(n):
        w.sum_s[d] = 0.0
    take_momentum(w, root, w.block_v, w.sum_s)
    row_speeds(w, rows, w.block_v, w.y, 0)
    for k in range(rows):
        w.y[k] += w.slip[k]


@inlined
def keep(w: KernelWorld, rows: int, n: int) -> None:
    """Keep impulses and velocities in ``columns``."""
    for k in range(rows):
        w.columns[k] = w.x[k]
    for d in range(n):
        w.columns[rows + d] = w.block_v[d]


@inlined
def restore(w: KernelWorld, rows: int, n: int) -> None:
    """Take the impulses and velocities that `keep` kept."""
    for k in range(rows):
        w.x[k] = w.columns[k]
    for d in range(n):
        w.block_v[d] = w.columns[rows + d]


@compiled
def solve_augmented(w: KernelWorld, root: int, rows: int, n: int, tiny: float) -> int:
    """Find velocities and impulses x that meet the law, from those of the last step.

    Returns:
        How many rounds it took, `MORE_ROUNDS` and one where velocities only come near the law; 0 in vain. The impulses
        ``before`` stay as they are.
    """
    if rows * w.sizes[WIDTH] > w.sizes[MATRIX]:
        return 0
    sweep_first(w, root, rows)
    begin(w, root, rows, n)
    hardness, balance, total, rounds, taken = SOFT, BALANCE, 0, 0, -1
    before = off = nearest = last = math.inf
    while total < TOTAL or (taken >= 0 and nearest <= NEAR and total < 2 * TOTAL):
        set_penalty(w, rows, hardness)
        used = hardness
        taken = descend_to_law(w, root, rows, n, balance)
        total += max(1, abs(taken))
        rounds += 1
        off = take_over(w, rows)
        if taken >= 0 and (off <= max(tiny, SOLVED) or GAIN * before < off <= NEAR):
            if balance == EXACT:
                return rounds
            balance, off = EXACT, math.inf
        elif taken >= 0 and off <= OFF and total > LONG and off > GAIN * before:
            return MORE_ROUNDS + 1
        elif taken < 0:
            if nearest <= OFF and total > LONG:
                break
            hardness = max(SOFTEST, SOFTER * hardness)
            if nearest <= OFF:
                restore(w, rows, n)
                begin(w, root, rows, n)
                off = nearest
        elif hardness >= last and off > max(NEAR, (GAIN if hardness == HARDEST else STUCK) * before):
            # Rows contradict each other: penetrations are corrected less.
            limit_corrections(w, rows)
            begin(w, root, rows, n)
        else:
            hardness = min(HARDEST, HARDER * hardness)
        if taken >= 0 and off < nearest:
            nearest = off
            keep(w, rows, n)
        before, last = off, used if taken >= 0 else math.inf
    if nearest > FAIR:
        return 0
    restore(w, rows, n)
    return MORE_ROUNDS + 1
