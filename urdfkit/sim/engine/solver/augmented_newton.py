"""Contacts and joint rows of a single tree by an augmented Lagrangian of Coulomb's law, in velocity space.

From impulses x, those of the last step, a round finds the velocities at which all rows exert P(x - D·w). Here w is the
velocity of a row, D its penalty, and P the projection onto the law: a normal impulse that does not pull, then friction
within the circle of this normal impulse. Newton's method finds them, with shorter steps where a whole step would not
come nearer. The next round starts from the impulses found. At the end P(x - D·w) = x, which is Coulomb's law itself.

Redundant contacts need no special treatment, because the velocities are the unknowns: an undetermined load stays as it
was. A soft penalty, of a few effective masses of a row, changes few contacts at a time and so converges from nearly
anywhere; a hard penalty needs fewer rounds. Therefore the penalty grows after rounds that converge and shrinks after
rounds that do not. Bodies at rest need one or two rounds with a hard penalty.

Sources: P. Alart and A. Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353-375; J. C. Simo and T. A. Laursen,
Comput. Struct. 42 (1992) 97-116 (the augmented Lagrangian).
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_forward
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import ATTEMPT, LAST_ATTEMPT, MATRIX
from urdfkit.sim.engine.solver.attempts import (
    BOUNDED,
    GUESSED,
    LIFTING,
    MOVING,
    RESTING,
    SWEPT,
    first_attempt,
    next_attempt,
    remember_attempt,
)
from urdfkit.sim.engine.solver.penalty_rows import (
    forget_matrix,
    imbalance,
    joint_row_count,
    linearise,
    matrix_changes,
    prepare,
    row_velocities,
)
from urdfkit.sim.engine.solver.tree_guesses import MOST_GUESSED, solve_without_rounds
from urdfkit.sim.engine.solver.tree_matrix import damped_inertia, factor_tree, multiply_inertia, solve_tree

HARD, SOFT, SOFTEST, HARDEST = 1e3, 10.0, 3.0, 1e4
"""Penalties over the effective mass of a row: of the first tries, of the last, and the bounds of the last."""
HARDER, SOFTER = 5.0, 0.3
"""Factors of the penalty after a round that converged, and after a round that did not."""
STEPS = 3
"""Most steps of Newton's method in a round."""
LIFT_TRY = 40
"""Steps from which on `LIFTING` is given up; it may soften the penalty before."""
FIRST_TRY, CONVERGES = 4, 0.1
"""Steps from which on the first try is given up, unless each round leaves less than this part of the one before."""
TOTAL, MORE = 45, 30
"""Steps of all rounds beyond which no other round begins, and how many more the attempt `BOUNDED` may take."""
SHORTER = (1.0, 0.3, 0.15, 0.075, 0.0375, 0.0125, 0.004, 0.0013)
"""Shares of a step that are tried: friction of a wheel that hardly slips turns within a small part of a step."""
BALANCE, EXACT = 1e-6, 1e-9
"""Parts of the largest impulse, also of the last step, by which momentum may be off in a round, and in the last one."""
SOLVED = 1e-10
"""Velocity [m/s or rad/s] that the next round may still change where the law is met."""
NEAR, GAIN = 1e-6, 0.7
"""The same where a round gains less than this factor over the one before, as where rows contradict each other."""
QUICK = 0.01
"""Factor that a round with a hard penalty gains over the one before, from which on the next has the same penalty, as it
has if the same gain again solves: where rows do the same, it has the same factors."""
MEMORY = 1.0 - 1e-6
"""How much of the last step's impulses is started from: a load that nothing determines slowly becomes even."""
EVEN, MOVES = 0.99, 1e-3
"""The same for a robot that moves faster than the second value [m/s or rad/s], whose friction depends on that load."""
FAIR = 1e-4
"""Velocity [m/s or rad/s] that the next round may still change for a result to be used where no round gains: of
`LIFTING`, which is a fortieth of its correction, and of the nearest round if all attempts fail."""
FEW_ROWS, FEW_DOFS = 20, 15
"""Rows, and dofs, up to which `active_set_newton.solve` is used instead: it is exact, and quick where it is small."""
MOST_ROWS, ATTEMPTS = 36, 5
"""Rows up to which guesses of the active set are tried first, and how many; not with more rows than dofs."""


@inlined
def touches_fixed(w: KernelWorld, tree: int, contact: int) -> bool:
    """Return whether an island is one tree of several bodies that touches only fixed shapes, see `tree_matrix`.

    Args:
        w: the world's arrays.
        tree: the only one of the island, or -1.
        contact: first of the island, or -1.
    """
    if tree < 0 or w.tree_body[tree + 1] - w.tree_body[tree] == 1 or w.tree_mimic[tree + 1] > w.tree_mimic[tree]:
        return False
    while contact >= 0:
        if w.contact_other[contact] >= 0:
            return False
        contact = w.contact_next[contact]
    return True


@inlined
def list_contacts(w: KernelWorld, first: int, contacts: int, alone: bool) -> int:
    """List the contacts of an island that have rows in ``index``; return how many."""
    count, k = 0, first
    while (k < contacts) if alone else (k >= 0):
        if w.contact_row[k] >= 0:
            w.index[count] = k
            count += 1
        k = k + 1 if alone else w.contact_next[k]
    return count


@inlined
def begin(w: KernelWorld, tree: int, stride: int, rows: int, joint_rows: int, contacts: int, attempt: int) -> None:
    """Start from the impulses ``before`` and the velocities that follow from these.

    Where contacts stay, impulses hardly change from step to step, so these velocities are nearer to the solution than
    those of the last step. They follow from all of these impulses, also where a part is the start: it takes 1 % of the
    load to turn the friction of wheels that hardly slip. How `BOUNDED` shares a load that nothing determines is
    arbitrary: when the jam ends, impulses start from nothing.
    """
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    memory = MEMORY
    if attempt != BOUNDED and w.attempt[ATTEMPT * tree + LAST_ATTEMPT] == BOUNDED:
        memory = 0.0
    elif attempt < MOVING:
        for d in range(first, beyond):
            if abs(w.v_start[d]) > MOVES:
                memory = EVEN
    for k in range(rows):
        w.x[k] = w.before[k] if memory > 0.0 else 0.0
        w.y[k] = w.velocity[k] = 0.0
    for d in range(first, beyond):
        w.sum_s[d] = w.slope_s[d] = 0.0
    imbalance(w, tree, stride, joint_rows, contacts, 0.0, 0.0, False)
    solve_forward(w, first, beyond)
    for d in range(first, beyond):
        w.sum_s[d] = w.block_f[d]
        w.block_v[d] = w.sum_v[d] + w.u[d]
    row_velocities(w, tree, stride, joint_rows, contacts, w.block_v, 1.0, w.y)
    for k in range(rows):
        w.x[k] *= memory


@compiled
def descend_tree(
    w: KernelWorld,
    tree: int,
    stride: int,
    rows: int,
    joint_rows: int,
    contacts: int,
    hardness: float,
    balance: float,
    inertia: Any,
    bounded: bool,
) -> int:
    """Make steps of Newton's method at a penalty; return how many, negative if the momentum is not balanced then."""
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    step = w.slope_v
    here = imbalance(w, tree, stride, joint_rows, contacts, hardness, 0.0, bounded)
    for done in range(STEPS + 1):
        largest = off = 0.0
        for k in range(rows):
            largest = max(largest, abs(w.ahead[k]), abs(w.before[k]))
        for d in range(first, beyond):
            off = max(off, abs(w.block_f[d]))
        if off <= balance * largest:
            return done
        if done == STEPS:
            break
        # At rest rows do the same in every step of a round, so that the factors stay the same.
        if matrix_changes(w, joint_rows, contacts, hardness, bounded):
            linearise(w, tree, stride, joint_rows, contacts, hardness, inertia, bounded)
            if not factor_tree(w, tree):
                forget_matrix(w)
                return -done - 1
        for d in range(first, beyond):
            step[d] = w.block_f[d]
        solve_tree(w, tree, step)
        row_velocities(w, tree, stride, joint_rows, contacts, step, 0.0, w.velocity)
        multiply_inertia(w, tree, inertia, step, w.slope_s)
        share = 1.0
        for share in SHORTER:
            now = imbalance(w, tree, stride, joint_rows, contacts, hardness, share, bounded)
            if now < here * (1.0 - 0.1 * share):
                break
        here = now
        for d in range(first, beyond):
            w.block_v[d] += share * step[d]
            w.sum_s[d] += share * w.slope_s[d]
            w.slope_s[d] = 0.0
        for k in range(rows):
            w.y[k] += share * w.velocity[k]
            w.velocity[k] = 0.0
    return -STEPS


@inlined
def take_over(w: KernelWorld, rows: int, hardness: float) -> float:
    """Take over the impulses of a round; return the velocity by which they differ from those before it."""
    off = 0.0
    k = 0
    while k < rows:
        penalty = hardness * w.row_stiffness[k]
        change = 0.0
        size = 3 if w.mu[k] > 0.0 else 1
        for row in range(k, k + size):
            change = max(change, abs(w.ahead[row] - w.x[row]))
            w.x[row] = w.ahead[row]
        if penalty > 0.0:
            off = max(off, change / penalty)
        k += size
    return off


@inlined
def limit_energy(w: KernelWorld, tree: int, rows: int, brought: float) -> None:
    """Make all impulses smaller that would bring energy: x·g + x·A·x/2, of which the second part is `brought`."""
    found = 0.0
    for k in range(rows):
        found += w.x[k] * w.y[k]
    if found + brought <= 0.0:
        return
    share = max(0.0, -found / brought) if brought > 0.0 else 0.0
    for k in range(rows):
        w.x[k] *= share
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):
        w.u[d] *= share


@compiled
def solve_single_tree(w: KernelWorld, tree: int, stride: int, rows: int, contacts: int) -> int:
    """Find the impulses x of the rows of a single tree, from ``before``; u becomes the change of its velocities.

    Args:
        w: the world's arrays.
        tree: touches only fixed shapes, and has no mimic joints.
        stride: entries of a row of Y, which is J.
        rows: how many there are.
        contacts: those with rows, in ``index``.

    Returns:
        How many steps of Newton's method it took, negative if velocities only come near the law.
    """
    first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
    joint_rows, inertia = joint_row_count(w, rows), w.v_ahead
    solve_forward(w, first, beyond)
    for d in range(first, beyond):
        w.u_free[d] = w.u[d]
        w.sum_v[d] = w.v_start[d] + w.u[d]
    damped_inertia(w, tree, inertia)
    prepare(w, tree, stride, joint_rows, contacts, inertia)
    attempt = first_try = first_attempt(w, tree, joint_rows, rows, contacts)
    guessed = rows <= MOST_GUESSED and rows * rows <= w.sizes[MATRIX]
    if attempt == SWEPT:
        attempt = RESTING
    elif attempt == GUESSED and not guessed:
        attempt = MOVING
    begin(w, tree, stride, rows, joint_rows, contacts, attempt)
    hardness, balance = SOFT if attempt == MOVING else HARD, BALANCE
    last_hardness = 0.0
    total = 0
    before = nearest = math.inf
    met = False
    while attempt != GUESSED and total < (TOTAL + MORE if attempt == BOUNDED else TOTAL) and not met:
        bounded = attempt == BOUNDED
        # Between these attempts the penalty differs, or the matrix does not.
        if hardness != last_hardness or (bounded and total == TOTAL):
            forget_matrix(w)
        last_hardness = hardness
        taken = descend_tree(w, tree, stride, rows, joint_rows, contacts, hardness, balance, inertia, bounded)
        total += max(1, abs(taken))
        off = take_over(w, rows, hardness)
        if taken >= 0 and off < nearest:
            nearest = off
            for k in range(rows):
                w.near_x[k] = w.x[k]
        near = FAIR if attempt == LIFTING else NEAR
        if taken >= 0 and (off <= (NEAR if bounded else SOLVED) or GAIN * before < off <= near):
            met = balance == EXACT
            balance = EXACT
        elif (attempt == LIFTING and total >= LIFT_TRY) or (
            attempt < MOVING
            and attempt != LIFTING
            and (taken < 0 or (attempt == RESTING and total >= FIRST_TRY and off > CONVERGES * before))
        ):
            total = 0 if attempt == LIFTING else total
            attempt, nearest = next_attempt(w, tree, attempt, joint_rows, rows, contacts), math.inf
            hardness = SOFT if attempt == MOVING else HARD
            begin(w, tree, stride, rows, joint_rows, contacts, attempt)
            off = math.inf
        elif attempt == MOVING and (total >= TOTAL or (taken == -1 and hardness == SOFTEST)):
            attempt, hardness, total = BOUNDED, SOFT, TOTAL
            begin(w, tree, stride, rows, joint_rows, contacts, attempt)
            off = math.inf
        elif taken < 0:
            hardness = max(SOFTEST, SOFTER * hardness)
        elif attempt >= MOVING or (attempt != RESTING and off > QUICK * before and off * off > SOLVED * before):
            hardness = min(HARDEST, HARDER * hardness)
        before = off
    if not met and nearest <= FAIR:
        for k in range(rows):
            w.x[k] = w.near_x[k]
    elif not met and guessed:
        total = solve_without_rounds(w, tree, stride, rows, first_try != SWEPT)
        remember_attempt(w, tree, first_try, GUESSED if total > 0 else SWEPT)
        return total if total > 0 else -TOTAL
    remember_attempt(w, tree, first_try, attempt)
    # Of the impulses found, so that momentum is kept whatever the accuracy.
    row_velocities(w, tree, stride, joint_rows, contacts, w.sum_v, 1.0, w.y)
    for d in range(first, beyond):
        w.sum_s[d] = w.slope_s[d] = 0.0
    brought = 0.5 * imbalance(w, tree, stride, joint_rows, contacts, 0.0, 0.0, False)
    if not met:
        limit_energy(w, tree, rows, brought)
    solve_forward(w, first, beyond)
    for d in range(first, beyond):
        w.u[d] += w.u_free[d]
    return total if met else -total
