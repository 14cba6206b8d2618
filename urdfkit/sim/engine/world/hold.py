"""Islands of several trees in which nothing slides, solved for their velocities.

Where all contacts hold or are open, the velocities minimise the energy of the change subject to linear equations, far
fewer unknowns than rows: a box on four points has six against twelve, and boxes that do not touch each other have
nothing to do with each other. With the rows taken for stiff dampers the matrix M + Jᵀ·D·J has a block for each tree and
for each pair of trees that touch. It is factored in the order in which the fewest blocks fill in, and the impulses are
corrected until the rows are where they should be (the method of multipliers), starting from those of the last step.

If the law then forbids something, rows are let go or held, a few times; an island that slides is left to `solve`.

Source: M. R. Hestenes, J. Optim. Theory Appl. 4 (1969) 303-320: multipliers.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.dynamics import solve_forward
from urdfkit.sim.engine.guess import AT_HIGH, AT_LOW, HOLDS
from urdfkit.sim.engine.world.blocks import arrange, assemble, eliminate, substitute

STIFFNESS = 1e6
"""Stiffness of a row that holds, over the inverse of what it feels of the masses."""
ROUNDS = 8
"""Most corrections of the impulses."""
REVISIONS = 12
"""How often what holds is changed before the island is left to `solve`."""
LIGHT = 1e-3
"""Impulse over the largest below which a contact is let go rather than left to slide."""


@inlined
def row_speed(floats: Any, integers: Any, k: int, x: Any) -> float:
    """Return J·x of a row, x in the order of the blocks."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    at = k * integers[WIDTH]
    tree = row_a[k]
    first, size = block_first[tree_block[tree]], tree_dof[tree + 1] - tree_dof[tree]
    total = 0.0
    for d in range(size):
        total += Y[at + d] * x[first + d]
    tree = row_b[k]
    if tree >= 0:
        at += size
        first = block_first[tree_block[tree]]
        for d in range(tree_dof[tree + 1] - tree_dof[tree]):
            total += Y[at + d] * x[first + d]
    return total


@inlined
def push_row(floats: Any, integers: Any, k: int, c: float, x: Any) -> None:
    """Add c·Jᵀ of a row to x, in the order of the blocks."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    block_first = field(integers, integers, At.block_first)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    Y = field(floats, integers, At.Y)
    at = k * integers[WIDTH]
    tree = row_a[k]
    first, size = block_first[tree_block[tree]], tree_dof[tree + 1] - tree_dof[tree]
    for d in range(size):
        x[first + d] += c * Y[at + d]
    tree = row_b[k]
    if tree >= 0:
        at += size
        first = block_first[tree_block[tree]]
        for d in range(tree_dof[tree + 1] - tree_dof[tree]):
            x[first + d] += c * Y[at + d]


@inlined
def take_momentum(floats: Any, integers: Any, root: int, x: Any, into: Any) -> None:
    """Take M·x off `into`, both in the order of the blocks."""
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    island_next = field(integers, integers, At.island_next)
    block_first = field(integers, integers, At.block_first)
    dof_row = field(integers, integers, At.dof_row)
    L = field(floats, integers, At.L)
    inverse_diagonal = field(floats, integers, At.inverse_diagonal)
    tree = root
    while tree >= 0:
        first, size = tree_dof[tree], tree_dof[tree + 1] - tree_dof[tree]
        at = block_first[tree_block[tree]]
        for k in range(size):
            row = dof_row[first + k] + first
            diagonal = L[row + k] * inverse_diagonal[first + k]
            total = diagonal * x[at + k]
            for j in range(k):
                total += L[row + j] * x[at + j]
            for j in range(k):
                into[at + j] -= L[row + j] * total
            into[at + k] -= diagonal * total
        tree = island_next[tree]


@inlined
def first_hold(floats: Any, integers: Any, rows: int) -> bool:
    """Guess from the last step's impulses what every row does; return False if a contact slid."""
    before = field(floats, integers, At.before)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    state = field(integers, integers, At.state)
    k = 0
    while k < rows:
        state[k] = HOLDS
        if mu[k] > 0.0:
            if not before[k] > 0.0:
                state[k] = AT_LOW
            elif math.sqrt(before[k + 1] ** 2 + before[k + 2] ** 2) >= (1.0 - 1e-9) * mu[k] * before[k]:
                return False
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        if low[k] == 0.0:
            state[k] = HOLDS if before[k] > 0.0 else AT_LOW
        elif before[k] >= high[k]:
            state[k] = AT_HIGH
        elif before[k] <= low[k]:
            state[k] = AT_LOW
        k += 1
    return True


@inlined
def revise(floats: Any, integers: Any, rows: int, speed: Any, tiny: float) -> int:
    """Change what the law forbids; return 0 if nothing had to change, 1 if something had, -1 if a contact slides."""
    g = field(floats, integers, At.slip)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    state = field(integers, integers, At.state)
    changed = 0
    heaviest = 0.0
    for k in range(rows):
        if mu[k] > 0.0:
            heaviest = max(heaviest, x[k])
    k = 0
    while k < rows:
        doing = state[k]
        if doing == HOLDS:
            if x[k] < low[k]:
                state[k] = AT_LOW
            elif x[k] > high[k]:
                state[k] = AT_HIGH
            elif mu[k] > 0.0 and math.sqrt(x[k + 1] ** 2 + x[k + 2] ** 2) > mu[k] * x[k] * (1.0 + 1e-9):
                if x[k] > LIGHT * heaviest:
                    return -1
                # It may as well carry nothing.
                state[k] = AT_LOW
        else:
            w = row_speed(floats, integers, k, speed) + g[k]
            if (doing == AT_LOW and w < -tiny) or (doing == AT_HIGH and w > tiny):
                state[k] = HOLDS
        if state[k] != doing:
            changed = 1
        if mu[k] > 0.0:
            state[k + 1] = state[k + 2] = state[k]
            k += 2
        k += 1
    return changed


@inlined
def correct(floats: Any, integers: Any, root: int, rows: int, n: int, tiny: float) -> bool:
    """Find velocities and impulses of the rows that hold; return whether all are where they should be."""
    stiffness = field(floats, integers, At.g)
    g = field(floats, integers, At.slip)
    x = field(floats, integers, At.x)
    speed = field(floats, integers, At.block_v)
    rest = field(floats, integers, At.block_f)
    state = field(integers, integers, At.state)
    for _ in range(ROUNDS):
        for d in range(n):
            rest[d] = 0.0
        take_momentum(floats, integers, root, speed, rest)
        for k in range(rows):
            c = x[k]
            if state[k] == HOLDS:
                c -= stiffness[k] * (row_speed(floats, integers, k, speed) + g[k])
            if c != 0.0:
                push_row(floats, integers, k, c, rest)
        substitute(floats, integers, n, rest)
        moved = worst = 0.0
        for d in range(n):
            speed[d] += rest[d]
            moved = max(moved, abs(rest[d]))
        for k in range(rows):
            if state[k] == HOLDS:
                error = row_speed(floats, integers, k, speed) + g[k]
                x[k] -= stiffness[k] * error
                worst = max(worst, abs(error))
        # Rows that contradict each other a little, as of a table on four feet, are met as nearly as can be.
        if worst <= tiny or moved <= tiny:
            return True
    return False


@compiled
def hold(floats: Any, integers: Any, root: int, rows: int) -> int:
    """Find the velocities of an island in which nothing slides, and the impulses x of its rows.

    Of the rows Y is J, of the trees u what `smooth_motion` left there. If it succeeds, u becomes the change of
    velocity; if not, all but working memory is as it was.

    Returns:
        How many sets of rows were tried; 0 where it did not succeed.
    """
    width = integers[WIDTH]
    tree_dof = field(integers, integers, At.tree_dof)
    tree_block = field(integers, integers, At.tree_block)
    island_next = field(integers, integers, At.island_next)
    block_first = field(integers, integers, At.block_first)
    dof_row = field(integers, integers, At.dof_row)
    row_a = field(integers, integers, At.row_a)
    row_b = field(integers, integers, At.row_b)
    state = field(integers, integers, At.state)
    Y = field(floats, integers, At.Y)
    M = field(floats, integers, At.M)
    u = field(floats, integers, At.u)
    v = field(floats, integers, At.v_start)
    bias = field(floats, integers, At.row_bias)
    before = field(floats, integers, At.before)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    x = field(floats, integers, At.x)
    stiffness = field(floats, integers, At.g)
    g = field(floats, integers, At.slip)
    speed = field(floats, integers, At.block_v)
    kept = field(floats, integers, At.v_ahead)
    if not first_hold(floats, integers, rows):
        return 0
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
        felt, at = 0.0, k * width
        for side in range(2):
            tree = row_a[k] if side == 0 else row_b[k]
            if tree >= 0:
                for d in range(tree_dof[tree], tree_dof[tree + 1]):
                    felt += Y[at] * Y[at] / M[dof_row[d] + d]
                    at += 1
        stiffness[k] = STIFFNESS / felt if felt > 0.0 else 0.0
    # As `solve` has it.
    tiny = 1e-11 * largest + 1e-14
    done = 0
    for tried in range(REVISIONS):
        for k in range(rows):
            x[k] = before[k] if state[k] == HOLDS else (low[k] if state[k] == AT_LOW else high[k])
            if state[k] != HOLDS and low[k] == -math.inf and high[k] == math.inf:
                # A tangent of a contact that is open.
                x[k] = 0.0
        for d in range(n):
            speed[d] = 0.0
        assemble(floats, integers, root, rows, n)
        if not eliminate(floats, integers, n):
            break
        there = correct(floats, integers, root, rows, n, tiny)
        changed = revise(floats, integers, rows, speed, tiny)
        if changed == 0 and there:
            done = tried + 1
        if changed <= 0:
            break
    tree = root
    while tree >= 0:
        first = tree_dof[tree]
        at = block_first[tree_block[tree]]
        for d in range(first, tree_dof[tree + 1]):
            u[d] = u[d] + speed[at + d - first] if done > 0 else kept[d]
        tree = island_next[tree]
    return done
