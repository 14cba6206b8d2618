"""Islands solved for the velocities of their trees, in blocks.

Where all contacts hold or are open, the velocities minimise the energy of the change subject to linear equations, far
fewer unknowns than rows: a box on four points has six against twelve, and boxes that do not touch each other have
nothing to do with each other. With the rows taken for stiff dampers the matrix M + Jᵀ·D·J has a block for each tree and
for each pair of trees that touch. It is factored in the order in which the fewest blocks fill in, and the impulses are
corrected until the rows are where they should be (the method of multipliers), starting from those of the last step.

If the law then forbids something, rows are let go or held, or contacts slide (see `slip`), some times over. Where that
leads nowhere, `cones` finds which do what, and it is tried once more from there.

Source: M. R. Hestenes, J. Optim. Theory Appl. 4 (1969) 303-320: multipliers.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.dynamics import solve_forward
from urdfkit.sim.engine.guess import HOLDS, SLIDES
from urdfkit.sim.engine.world.blocks import arrange, assemble, eliminate
from urdfkit.sim.engine.world.cones import give_way, leave_wedged
from urdfkit.sim.engine.world.products import push_row, row_speed, take_momentum
from urdfkit.sim.engine.world.revise import first_hold, revise, start_over
from urdfkit.sim.engine.world.slip import STIFFNESS, follow, slide, substitute_all

NOT_MET, MET, CONTRADICT = range(3)
"""Whether rows are where they should be."""
ROUNDS = 8
"""Most corrections of the impulses."""
SLIDING_ROUNDS = 3
"""The same where contacts slide, before their directions are taken anew."""
REVISIONS = 8
"""How often what rows do is changed before it is given up."""
CONTRARY = 5e-3
"""Velocity [m/s or rad/s] by which rows that contradict each other may be off: 5 µm in a step of 1 ms."""
WEDGED = 1e-4
"""Velocity [m/s or rad/s] by which rows are off after all rounds of `give_way` where they contradict each other."""
MEMORY = 0.99
"""How much of the last step's impulses `give_way` starts from."""


@inlined
def push_all(floats: Any, integers: Any, rows: int, speed: Any, rest: Any) -> None:
    """Add to `rest` what all rows exert at these velocities."""
    stiffness = field(floats, integers, At.g)
    g = field(floats, integers, At.slip)
    mu = field(floats, integers, At.mu)
    near = field(floats, integers, At.near_x)
    x = field(floats, integers, At.x)
    state = field(integers, integers, At.state)
    k = 0
    while k < rows:
        if state[k] == SLIDES:
            c = x[k] - stiffness[k] * (row_speed(floats, integers, k, speed) + g[k])
            first = row_speed(floats, integers, k + 1, speed) + g[k + 1]
            second = row_speed(floats, integers, k + 2, speed) + g[k + 2]
            a, b = near[k + 1], near[k + 2]
            across = near[k] * (a * second - b * first)
            push_row(floats, integers, k, c, rest)
            push_row(floats, integers, k + 1, b * across - mu[k] * c * a, rest)
            push_row(floats, integers, k + 2, -a * across - mu[k] * c * b, rest)
            k += 3
            continue
        c = x[k]
        if state[k] == HOLDS:
            c -= stiffness[k] * (row_speed(floats, integers, k, speed) + g[k])
        if c != 0.0:
            push_row(floats, integers, k, c, rest)
        k += 1


@inlined
def turn(floats: Any, integers: Any, k: int, speed: Any) -> float:
    """Turn friction against the slip; return the velocity by which that, or the normal, is not where it should be."""
    stiffness = field(floats, integers, At.g)
    g = field(floats, integers, At.slip)
    mu = field(floats, integers, At.mu)
    near = field(floats, integers, At.near_x)
    x = field(floats, integers, At.x)
    w = row_speed(floats, integers, k, speed) + g[k]
    first = row_speed(floats, integers, k + 1, speed) + g[k + 1]
    second = row_speed(floats, integers, k + 2, speed) + g[k + 2]
    a, b = near[k + 1], near[k + 2]
    c = x[k] - stiffness[k] * w
    forward, across = a * first + b * second, a * second - b * first
    turned = near[k] * across
    off = abs(turned)
    if forward > 0.0:
        size = math.sqrt(first * first + second * second)
        off = mu[k] * abs(c) * (1.0 - forward / size) + abs(mu[k] * c * across / size - turned)
        a, b = first / size, second / size
    near[k + 1], near[k + 2] = a, b
    x[k], x[k + 1], x[k + 2] = c, -mu[k] * c * a, -mu[k] * c * b
    return float(max(abs(w), off * STIFFNESS / stiffness[k]))


@compiled
def correct(floats: Any, integers: Any, root: int, rows: int, n: int, sliding: int, tiny: float) -> int:
    """Find velocities and impulses of the rows that hold or slide; return whether all are where they should be."""
    stiffness = field(floats, integers, At.g)
    g = field(floats, integers, At.slip)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    speed = field(floats, integers, At.block_v)
    rest = field(floats, integers, At.block_f)
    state = field(integers, integers, At.state)
    for _ in range(ROUNDS if sliding == 0 else SLIDING_ROUNDS):
        for d in range(n):
            rest[d] = 0.0
        take_momentum(floats, integers, root, speed, rest)
        push_all(floats, integers, rows, speed, rest)
        if not substitute_all(floats, integers, n, sliding, rest):
            return NOT_MET
        moved = worst = 0.0
        for d in range(n):
            speed[d] += rest[d]
            moved = max(moved, abs(rest[d]))
        for k in range(rows):
            if state[k] == HOLDS:
                error = row_speed(floats, integers, k, speed) + g[k]
                x[k] -= stiffness[k] * error
                worst = max(worst, abs(error))
            elif state[k] == SLIDES and mu[k] > 0.0:
                worst = max(worst, turn(floats, integers, k, speed))
        if worst <= tiny:
            return MET
        if moved <= tiny:
            return CONTRADICT if worst <= CONTRARY else NOT_MET
    return NOT_MET


@inlined
def ease(floats: Any, integers: Any, rows: int, tiny: float) -> bool:
    """Let rows that hold take back less of what they are off, or close less of a gap, so that none contradicts another.

    Returns:
        Whether that is enough. It is not where motors or friction are among them: these have to give in instead.
    """
    high = field(floats, integers, At.high)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.slip)
    speed = field(floats, integers, At.block_v)
    state = field(integers, integers, At.state)
    for k in range(rows):
        if state[k] == HOLDS:
            error = abs(row_speed(floats, integers, k, speed) + g[k])
            if error > tiny and (high[k] < math.inf or error > abs(bias[k])):
                return False
    for k in range(rows):
        if state[k] == HOLDS:
            g[k] -= row_speed(floats, integers, k, speed) + g[k]
    return True


@compiled
def try_states(floats: Any, integers: Any, root: int, rows: int, n: int, tiny: float) -> int:
    """Find what rows do, beginning with what ``state`` says; return how many sets were tried, 0 if in vain."""
    state = field(integers, integers, At.state)
    one_before = two_before = -1
    changed = True
    for tried in range(REVISIONS):
        if changed:
            start_over(floats, integers, rows, n)
        assemble(floats, integers, root, rows, n, False)
        if not eliminate(floats, integers, n):
            return 0
        sliding = follow(floats, integers, rows, n)
        there = correct(floats, integers, root, rows, n, sliding, tiny)
        if there == CONTRADICT:
            # As of a table on four feet: they are met as nearly as can be, and no impulses grow of what is left.
            there = NOT_MET
            if ease(floats, integers, rows, tiny):
                start_over(floats, integers, rows, n)
                there = correct(floats, integers, root, rows, n, sliding, tiny)
        changed = revise(floats, integers, rows, tiny)
        if changed:
            # Where what rows do comes round again, it will for ever.
            now = 0
            for k in range(rows):
                now = 5 * now + state[k] + 1
            if now in (one_before, two_before):
                return 0
            one_before, two_before = now, one_before
        else:
            if there != NOT_MET:
                return tried + 1
            if sliding == 0:
                return 0
    return 0


@inlined
def feel(floats: Any, integers: Any, rows: int) -> None:
    """Give every row that holds its stiffness, from what it feels of the masses."""
    width = integers[WIDTH]
    tree_dof = field(integers, integers, At.tree_dof)
    dof_row = field(integers, integers, At.dof_row)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    M = field(floats, integers, At.M)
    stiffness = field(floats, integers, At.g)
    for k in range(rows):
        felt, at = 0.0, k * width
        for side in range(2):
            tree = row_a[k] if side == 0 else row_b[k]
            if tree >= 0:
                for d in range(tree_dof[tree], tree_dof[tree + 1]):
                    felt += Y[at] * Y[at] / M[dof_row[d] + d]
                    at += 1
        stiffness[k] = STIFFNESS / felt if felt > 0.0 else 0.0


@compiled
def try_from_anywhere(floats: Any, integers: Any, root: int, rows: int, n: int, tiny: float) -> int:
    """Do the same where nothing is known of what rows do; return how many sets, more than there are if in vain.

    Then velocities and impulses are those of `give_way`, near the law.
    """
    speed = field(floats, integers, At.block_v)
    kept = field(floats, integers, At.sum_v)
    g = field(floats, integers, At.slip)
    before = field(floats, integers, At.before)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    near = field(floats, integers, At.near_x)
    state = field(integers, integers, At.state)
    for d in range(n):
        speed[d] = 0.0
    for k in range(rows):
        x[k] = MEMORY * before[k]
    for stage in range(3):
        feel(floats, integers, rows)
        if stage == 0:
            give_way(floats, integers, root, rows, n, 1, False, 1e-4, 1e-2)
        elif stage == 1:
            give_way(floats, integers, root, rows, n, 3, False, 1e-3, 1e-4)
        else:
            off = give_way(floats, integers, root, rows, n, 6, True, 1e-3, 1e-6)
            if off > WEDGED:
                leave_wedged(floats, integers, rows)
                for d in range(n):
                    speed[d] = 0.0
                for k in range(rows):
                    x[k] = 0.0
                feel(floats, integers, rows)
                give_way(floats, integers, root, rows, n, 2, False, 1e-4, 1e-2)
                feel(floats, integers, rows)
                give_way(floats, integers, root, rows, n, 6, True, 1e-3, 1e-6)
        feel(floats, integers, rows)
        for d in range(n):
            kept[d] = speed[d]
        for k in range(rows):
            before[k] = x[k]
            if state[k] == SLIDES and mu[k] > 0.0:
                first = row_speed(floats, integers, k + 1, speed) + g[k + 1]
                second = row_speed(floats, integers, k + 2, speed) + g[k + 2]
                slide(floats, integers, k, near[k + 1], near[k + 2], math.sqrt(first * first + second * second), x[k])
        tried = try_states(floats, integers, root, rows, n, tiny)
        if tried > 0:
            return tried + REVISIONS * stage
        for d in range(n):
            speed[d] = kept[d]
        for k in range(rows):
            x[k] = before[k]
    return 3 * REVISIONS + 1


@compiled
def hold(floats: Any, integers: Any, root: int, rows: int) -> int:
    """Find the velocities of an island, and the impulses x of its rows.

    Of the rows Y is J, of the trees u what `smooth_motion` left there. If it succeeds, u becomes the change of
    velocity; if not, all but working memory is as it was.

    Returns:
        How many sets of rows were tried, negative if `give_way` helped; 0 where it did not succeed.
    """
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    island_next = field(integers, integers, At.island_next)
    block_first = field(integers, integers, At.block_first)
    u = field(floats, integers, At.u)
    v = field(floats, integers, At.v_start)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.slip)
    speed = field(floats, integers, At.block_v)
    kept = field(floats, integers, At.v_ahead)
    n = arrange(floats, integers, root, rows)
    if n == 0:
        return 0
    tree = root
    while tree >= 0:
        first, beyond = tree_dof[tree], tree_dof[tree + 1]
        for d in range(first, beyond):
            kept[d] = u[d]
        solve_forward(floats, integers, first, beyond)
        at = block_first[tree_block[tree]]
        for d in range(first, beyond):
            speed[at + d - first] = v[d] + u[d]
        tree = island_next[tree]
    largest = 0.0
    for k in range(rows):
        g[k] = bias[k] + row_speed(floats, integers, k, speed)
        largest = max(largest, abs(g[k]))
    feel(floats, integers, rows)
    first_hold(floats, integers, rows)
    # As `solve` has it.
    tiny = 1e-11 * largest + 1e-14
    done = try_states(floats, integers, root, rows, n, tiny)
    if done == 0:
        done = -try_from_anywhere(floats, integers, root, rows, n, tiny)
    tree = root
    while tree >= 0:
        first = tree_dof[tree]
        at = block_first[tree_block[tree]]
        for d in range(first, tree_dof[tree + 1]):
            u[d] = u[d] + speed[at + d - first] if done != 0 else kept[d]
        tree = island_next[tree]
    return done
