"""Active-set method for an island: guess the state of each row (free, held, sliding), solve, and revise the guess.

Held rows are stiff dampers, and their impulses are corrected until the rows are met (the method of multipliers),
starting from the impulses of the last step. Rows whose solution contradicts Coulomb's law or a limit then change their
state, for contacts that slide see `coulomb_direction`, and the island is solved again, at most `REVISIONS` times.

Source: M. R. Hestenes, J. Optim. Theory Appl. 4 (1969) 303-320: multipliers.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.island_solver.active_set_revision import revise, start_over
from urdfkit.sim.engine.island_solver.block_assembly import assemble
from urdfkit.sim.engine.island_solver.block_matrix import eliminate
from urdfkit.sim.engine.island_solver.coulomb_direction import STIFFNESS, follow, substitute_all
from urdfkit.sim.engine.island_solver.jacobian_products import push_contact, push_row, row_speeds, take_momentum
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.solver.row_states import HOLDS, SLIDES

NOT_MET, MET, CONTRADICT = range(3)
"""Whether rows are where they should be."""
ROUNDS = 8
"""Most corrections of the impulses."""
SLIDING_ROUNDS = 3
"""The same where contacts slide, before their directions are updated."""
REVISIONS = 8
"""How often what rows do is changed before it is given up."""
LEAST = 1e-12
"""Ratio of the impulses that are rounding to the largest that can be: they let nothing slide."""
CONTRARY = 5e-3
"""Velocity [m/s or rad/s] by which rows that contradict each other may be off: 5 µm in a step of 1 ms."""


@inlined
def push_all(w: KernelWorld, rows: int, rest: Any) -> None:
    """Add to `rest` what all rows exert at the velocities that they are off by."""
    stiffness, off = w.g, w.y
    k = 0
    while k < rows:
        if w.mu[k] > 0.0:
            if w.state[k] == SLIDES:
                a, b = w.near_x[k + 1], w.near_x[k + 2]
                c, across = w.x[k] - stiffness[k] * off[k], w.near_x[k] * (a * off[k + 2] - b * off[k + 1])
                first, second = b * across - w.mu[k] * c * a, -a * across - w.mu[k] * c * b
                push_contact(w, k, c, first, second, rest)
            elif w.state[k] == HOLDS:
                c, first = w.x[k] - stiffness[k] * off[k], w.x[k + 1] - stiffness[k + 1] * off[k + 1]
                second = w.x[k + 2] - stiffness[k + 2] * off[k + 2]
                push_contact(w, k, c, first, second, rest)
            k += 3
            continue
        c = w.x[k]
        if w.state[k] == HOLDS:
            c -= stiffness[k] * off[k]
        if c != 0.0:
            push_row(w, k, c, rest)
        k += 1


@inlined
def update_friction_direction(w: KernelWorld, k: int) -> float:
    """Set friction opposite to the slip; return the residual of normal velocity and friction, as a velocity."""
    stiffness, velocity, near = w.g, w.y, w.near_x
    normal, first, second = velocity[k], velocity[k + 1], velocity[k + 2]
    a, b = near[k + 1], near[k + 2]
    c = w.x[k] - stiffness[k] * normal
    forward, across = a * first + b * second, a * second - b * first
    turned = near[k] * across
    off = abs(turned)
    if forward > 0.0:
        size = math.sqrt(first * first + second * second)
        off = w.mu[k] * abs(c) * (1.0 - forward / size) + abs(w.mu[k] * c * across / size - turned)
        a, b = first / size, second / size
    near[k + 1], near[k + 2] = a, b
    w.x[k], w.x[k + 1], w.x[k + 2] = c, -w.mu[k] * c * a, -w.mu[k] * c * b
    return float(max(abs(normal), off * STIFFNESS / stiffness[k]))


@compiled
def correct(w: KernelWorld, root: int, rows: int, n: int, sliding: int, tiny: float) -> int:
    """Find velocities and impulses of the rows that hold or slide; return whether all are where they should be.

    Before and after, y is the velocity of each row that should be none.
    """
    stiffness, off, speed, rest = w.g, w.y, w.block_v, w.block_f
    for _ in range(ROUNDS if sliding == 0 else SLIDING_ROUNDS):
        for d in range(n):
            rest[d] = 0.0
        take_momentum(w, root, speed, rest)
        push_all(w, rows, rest)
        if not substitute_all(w, n, sliding, rest):
            return NOT_MET
        moved = worst = 0.0
        for d in range(n):
            speed[d] += rest[d]
            moved = max(moved, abs(rest[d]))
        row_speeds(w, rows, speed, off, 0)
        for k in range(rows):
            off[k] += w.slip[k]
            if w.state[k] == HOLDS:
                w.x[k] -= stiffness[k] * off[k]
                worst = max(worst, abs(off[k]))
        if sliding > 0:
            for k in range(rows):
                if w.state[k] == SLIDES and w.mu[k] > 0.0:
                    worst = max(worst, update_friction_direction(w, k))
        if worst <= tiny:
            return MET
        if moved <= tiny:
            return CONTRADICT if worst <= CONTRARY else NOT_MET
    return NOT_MET


@inlined
def relax_rows(w: KernelWorld, rows: int, tiny: float) -> bool:
    """Relax the targets of active rows that contradict each other: they correct less of an error or gap.

    Returns:
        Whether the rows agree then. False if motors or friction are among them: their state has to change instead.
    """
    off = w.y
    for k in range(rows):
        if w.state[k] == HOLDS:
            error = abs(off[k])
            if error > tiny and (w.high[k] < math.inf or error > abs(w.row_bias[k])):
                return False
    for k in range(rows):
        if w.state[k] == HOLDS:
            w.slip[k] -= off[k]
    return True


@compiled
def try_states(w: KernelWorld, root: int, rows: int, n: int, tiny: float, most: float) -> int:
    """Find what rows do, beginning with those in ``state``; return how many sets were tried, 0 if in vain.

    Impulses beyond `most` come from rows that contradict each other, and are no basis for a revision.
    """
    one_before = two_before = -1
    changed = True
    for tried in range(REVISIONS):
        if changed:
            start_over(w, rows, n)
        assemble(w, root, rows, n, False)
        if not eliminate(w, n):
            return 0
        sliding = follow(w, rows, n)
        there = correct(w, root, rows, n, sliding, tiny)
        if there == CONTRADICT:
            # For example a table on four feet: meet the rows as nearly as possible, so that no impulses grow.
            there = NOT_MET
            if relax_rows(w, rows, tiny):
                start_over(w, rows, n)
                there = correct(w, root, rows, n, sliding, tiny)
        if there == NOT_MET:
            largest = 0.0
            for k in range(rows):
                largest = max(largest, abs(w.x[k]))
            if not largest <= most:
                return 0
        changed = revise(w, rows, tiny, LEAST * most)
        if changed:
            # Where what rows do comes round again, it will for ever.
            now = 0
            for k in range(rows):
                now = 5 * now + w.state[k] + 1
            if now in (one_before, two_before):
                return 0
            one_before, two_before = now, one_before
        else:
            if there != NOT_MET:
                return tried + 1
            if sliding == 0:
                return 0
    return 0
