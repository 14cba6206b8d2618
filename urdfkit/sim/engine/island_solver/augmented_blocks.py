"""Islands for which guesses fail: an augmented Lagrangian of Coulomb's law, for the velocities and in blocks.

The method is that of `augmented_newton`: a round finds the velocities at which all rows exert P(x - D·w), P the
projection onto the law, and the next round starts from these impulses with a harder penalty D. Because friction grows
with the normal impulse of the same round, no correction for slip has to settle from round to round, as the convex
problems of `convex_newton` need it. A step of Newton's method has the matrix of `active_set`, with a softer penalty.
A few sweeps find most of what rows do before the first round.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_forward
from urdfkit.sim.engine.island_solver.augmented_lagrangian import MORE_ROUNDS, OFF
from urdfkit.sim.engine.island_solver.block_assembly import assemble
from urdfkit.sim.engine.island_solver.block_matrix import eliminate, place_rows
from urdfkit.sim.engine.island_solver.coulomb_direction import follow, substitute_all
from urdfkit.sim.engine.island_solver.gauss_seidel import prepare, sweep_both_ways
from urdfkit.sim.engine.island_solver.jacobian_products import push_contact, push_row, row_speeds, take_momentum
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import WIDTH
from urdfkit.sim.engine.solver.augmented_newton import BALANCE, EXACT, GAIN, HARDER, NEAR, SOFTER, SOLVED
from urdfkit.sim.engine.solver.row_states import AT_HIGH, AT_LOW, HOLDS, SLIDES

SOFT, SOFTEST, HARDEST = 5e-5, 3e-6, 1e-2
"""Penalties over the stiffness of a held row: of the first round, and the bounds of the others."""
STEPS, TOTAL = 4, 60
"""Most steps of Newton's method in a round, and of all rounds beyond which no other begins."""
LONG = 20
"""Steps after which velocities that only come near the law are accepted: the convex problems come no nearer, in many
more steps. Most islands take fewer steps."""
MEMORY = 0.99
"""How much of the last step's impulses is started from."""
SHORTER = (1.0, 0.3, 0.15, 0.075, 0.0375)
"""Shares of a step that are tried; with the shorter ones of a single robot, some piles need more rounds."""
SWEEPS = 5
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
def imbalance(w: KernelWorld, rows: int, n: int, share: float, ahead: int) -> float:
    """Find what all rows exert at a share of a step, and write Jᵀ·P - M·v into ``block_f``; return its square.

    The speeds of rows along the step are in A from `ahead` on, and M times the step in ``sum_v``.
    """
    x, speeds, stiffness, exerted, rest, A = w.x, w.y, w.g, w.ahead, w.block_f, w.A
    for d in range(n):
        rest[d] = w.sum_s[d] + share * w.sum_v[d]
    k = 0
    while k < rows:
        D = stiffness[k]
        z = x[k] - D * (speeds[k] + share * A[ahead + k])
        if w.mu[k] == 0.0:
            exerted[k] = min(w.high[k], max(w.low[k], z))
            if exerted[k] != 0.0:
                push_row(w, k, exerted[k], rest)
            k += 1
            continue
        a = b = 0.0
        if z > 0.0:
            a = x[k + 1] - D * (speeds[k + 1] + share * A[ahead + k + 1])
            b = x[k + 2] - D * (speeds[k + 2] + share * A[ahead + k + 2])
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
    ahead = 2 * w.sizes[WIDTH]
    for k in range(rows):
        w.A[ahead + k] = 0.0
    for d in range(n):
        inertia[d] = 0.0
    here = imbalance(w, rows, n, 0.0, ahead)
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
        assemble(w, root, rows, n, False)
        if not eliminate(w, n) or not substitute_all(w, n, follow(w, rows, n), step):
            return -done - 1
        take_momentum(w, root, step, inertia)
        row_speeds(w, rows, step, w.A, ahead)
        share = 1.0
        for share in SHORTER:
            now = imbalance(w, rows, n, share, ahead)
            if now < here * (1.0 - 0.1 * share):
                break
        here = now
        for d in range(n):
            speed[d] += share * step[d]
            w.sum_s[d] += share * inertia[d]
        for k in range(rows):
            w.y[k] += share * w.A[ahead + k]
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
        w.columns[k] = w.Y[k]
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
    for _ in range(SWEEPS):
        sweep_both_ways(w, rows)
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
        w.Y[k] = w.columns[k]
    place_rows(w, rows)


@inlined
def begin(w: KernelWorld, root: int, rows: int, n: int) -> None:
    """Compute the speeds of the rows and the momentum at the velocities ``block_v``, and the metric of `imbalance`."""
    light: Any = w.slope_v
    tree = root
    while tree >= 0:
        first, at = w.tree_dof[tree], w.block_first[w.tree_block[tree]]
        for d in range(first, w.tree_dof[tree + 1]):
            light[at + d - first] = 1.0 / w.M[w.dof_row[d] + d]
        tree = w.island_next[tree]
    for d in range(n):
        w.sum_s[d] = 0.0
    take_momentum(w, root, w.block_v, w.sum_s)
    row_speeds(w, rows, w.block_v, w.y, 0)
    for k in range(rows):
        w.y[k] += w.slip[k]


@compiled
def solve_augmented(w: KernelWorld, root: int, rows: int, n: int, tiny: float) -> int:
    """Find velocities and impulses x that meet the law, from those of the last step.

    Returns:
        How many rounds it took, `MORE_ROUNDS` and one where velocities only come near the law; 0 in vain. The impulses
        ``before`` stay as they are.
    """
    sweep_first(w, root, rows)
    begin(w, root, rows, n)
    hardness, balance, total, rounds, taken = SOFT, BALANCE, 0, 0, -1
    before = off = math.inf
    while total < TOTAL:
        set_penalty(w, rows, hardness)
        taken = descend_to_law(w, root, rows, n, balance)
        total += max(1, abs(taken))
        rounds += 1
        off = take_over(w, rows)
        if taken >= 0 and (off <= max(tiny, SOLVED) or GAIN * before < off <= NEAR):
            if balance == EXACT:
                return rounds
            balance = EXACT
        elif total > LONG and taken >= 0 and GAIN * before < off <= OFF:
            break
        elif taken < 0:
            hardness = max(SOFTEST, SOFTER * hardness)
        elif hardness == HARDEST and off > max(NEAR, GAIN * before):
            return 0  # rows contradict each other
        else:
            hardness = min(HARDEST, HARDER * hardness)
        before = off
    return MORE_ROUNDS + 1 if taken >= 0 and off <= OFF else 0
