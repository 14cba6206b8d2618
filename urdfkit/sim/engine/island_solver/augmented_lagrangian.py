"""Islands whose rows contradict each other, or slide in many places: a convex problem, and another from its result.

A round minimises a convex function (see `convex_newton`) from the last step's velocities and impulses: what lies, lies
there already. The first rounds are soft, which takes few steps, the others a hundred times as hard. Rounds end once the
next would change nothing.

Corrections of penetrations seldom fit together where a body rests on more points than it needs; each round drops the
part that it could not correct. Otherwise, the impulses of rows that can never be met would grow.
"""

import math

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.island_solver.active_set import try_states
from urdfkit.sim.engine.island_solver.convex_newton import (
    STEPS,
    descend,
    limit_corrections,
    prepare_round,
    update_multipliers,
)
from urdfkit.sim.engine.island_solver.coulomb_direction import slide, stiffen
from urdfkit.sim.engine.island_solver.jacobian_products import row_speed
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.solver.row_states import SLIDES

HARDNESS = (1e-3, 1e-3, 1e-3, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2, 1e-2)
"""Of each round, the stiffness of its rows over that of rows that hold."""
BALANCE = (1e-3, 1e-3, 1e-3, 1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-7, 1e-7)
"""Of each round, the part of the impulses by which it may be out of balance."""
MORE_ROUNDS = 40
"""Most rounds, all after those like the last: an arm between a wall and what drives it there takes some twenty."""
NEARER, STUCK = 0.98, 8
"""By which factor a round comes nearer than all before, and how many that do not are borne: more are a contradiction.

Where slips and impulses drive each other, rounds go about their goal in a spiral, five or so away from it at a time.
"""
OFF = 1e-4
"""Velocity [m/s or rad/s] that the next round must still change for there to be more than those of the table."""
HEAP = 100
"""Rows beyond which an island is a heap."""
HEAP_ROUNDS = 2
"""Rounds of a heap, after which only rounds follow that gain: the next step continues from there."""
HEAP_STEPS, HEAP_TOTAL = 4, 10
"""Most steps of Newton's method in a round of a heap, and those of all rounds beyond which no other begins: the next
step continues from there."""
GROSS = 1e-2
"""Velocity [m/s or rad/s] by which rounds may violate the law in a heap: the sweeps leave as much, and sway.

Where the law is violated by more already at the velocities of the last step, as where a body strikes, two rounds do not
come nearer. What lies is off by no more than a tenth of a millimetre per second.
"""
TRIED_AFTER = 5
"""Rounds after which `active_set` is tried once more: where slips are slow to settle that is quicker."""
SOLVED = 1e-10
"""Velocity [m/s or rad/s] that the next round may still change where the law is met."""
NEAR = 5e-6
"""The same where rounds gain nothing more, as where rows still contradict each other."""
GAIN = 0.4
"""Ratio of the change in a round to the change before it, from which on rounds gain nothing."""
MEMORY = 0.99
"""How much of the last step's impulses is started from."""


@compiled
def try_from_here(w: KernelWorld, root: int, rows: int, n: int, tiny: float, most: float) -> bool:
    """Try what rows do in the result of a round; return whether the law is met, and leave the result if it is not."""
    speed, kept = w.block_v, w.sum_v
    stiffen(w, rows)
    for d in range(n):
        kept[d] = speed[d]
    for k in range(rows):
        w.before[k] = w.x[k]
        if w.state[k] == SLIDES and w.mu[k] > 0.0:
            first = row_speed(w, k + 1, speed) + w.slip[k + 1]
            second = row_speed(w, k + 2, speed) + w.slip[k + 2]
            slide(w, k, w.near_x[k + 1], w.near_x[k + 2], math.sqrt(first * first + second * second), w.x[k])
    if try_states(w, root, rows, n, tiny, most) > 0:
        return True
    for d in range(n):
        speed[d] = kept[d]
    for k in range(rows):
        w.x[k] = w.before[k]
    return False


@compiled
def go_round(w: KernelWorld, root: int, rows: int, n: int, tiny: float, most: float) -> int:
    """Continue from the current velocities and the impulses ``before``, until the law is met or no better met.

    Returns:
        How many rounds it took, one more than the most where velocities only come near the law; 0 for a heap where
        they do not: rows are no longer what they were, then.
    """
    heap, start = rows > HEAP, w.near_x
    for k in range(rows):
        w.x[k] = start[k] = MEMORY * w.before[k]
    if heap:
        prepare_round(w, rows, HARDNESS[0], True)
        if update_multipliers(w, rows) > GROSS:
            return 0
        for k in range(rows):
            w.x[k] = start[k]
    off, least, stuck, taken = math.inf, math.inf, 0, 0
    for done in range(MORE_ROUNDS):
        if done == TRIED_AFTER and not heap and try_from_here(w, root, rows, n, tiny, most):
            return done
        row = min(done, len(HARDNESS) - 1)
        prepare_round(w, rows, HARDNESS[row], done > 0)
        taken += descend(w, root, rows, n, BALANCE[row], HEAP_STEPS if heap else STEPS)
        was = off
        off = update_multipliers(w, rows)
        if off <= max(tiny, SOLVED) or (off <= NEAR and (heap or GAIN * was < off)):
            return done + 1
        last = done + 1 >= HEAP_ROUNDS and (off > GROSS or (done > 3 and off > GAIN * was))
        if heap and (last or taken >= HEAP_TOTAL):
            break
        limit_corrections(w, rows)
        if done + 1 < len(HARDNESS):
            least = off
            continue
        stuck = 0 if off < NEARER * least else stuck + 1
        least = min(least, off)
        if off <= OFF or stuck >= STUCK:
            break
    return 0 if heap and off > GROSS else MORE_ROUNDS + 1
