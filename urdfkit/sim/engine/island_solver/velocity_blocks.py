"""Islands solved for the velocities of their trees, in blocks.

Where all contacts hold or are open, the velocities minimise the energy of the change subject to linear equations, far
fewer unknowns than rows: a box on four points has six against twelve, and boxes that do not touch each other have
nothing to do with each other. With the rows taken for stiff dampers the matrix M + Jᵀ·D·J has a block for each tree and
for each pair of trees that touch. It is factored in the order in which the fewest blocks fill in.

`active_set` tries what rows do, from what they did in the last step; in heaps only at rest, since elsewhere they change
in too many places. If that fails, a tree alone, or a small island at rest, is tried once more with tiny penetrations
and gaps left as they are: they contradict rows that hold, of friction too, as at a robot that is jammed, or at boxes
that lean on each other. The next steps then begin with that. If it fails as well, `augmented_blocks` solves the law
with a penalty where rows are fast; if that fails, too, `augmented_lagrangian` gets there from anywhere.
"""

import math

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.dynamics.mass_matrix import solve_forward
from urdfkit.sim.engine.island_solver.active_set import try_states
from urdfkit.sim.engine.island_solver.active_set_revision import first_hold
from urdfkit.sim.engine.island_solver.augmented_blocks import solve_augmented
from urdfkit.sim.engine.island_solver.augmented_lagrangian import HEAP, go_round
from urdfkit.sim.engine.island_solver.block_matrix import arrange
from urdfkit.sim.engine.island_solver.coulomb_direction import STIFFNESS, compute_row_stiffness, stiffen
from urdfkit.sim.engine.island_solver.jacobian_products import row_speeds
from urdfkit.sim.engine.kernel_world import KernelWorld

WILD = 30.0
"""Ratio of impulses that mean nothing to the largest of the last step, or that stops what moves."""
CALM = 1e-5
"""Velocity [m/s or rad/s] of loaded rows up to which a heap is at rest, and what its rows do is guessed."""
LEAST = 2e-5
"""Velocity [m/s or rad/s] up to which penetrations and gaps are left where nothing else will do: 20 nm in 1 ms."""

FAST = 0.1
"""Velocity [m/s or rad/s] of a row without impulses from which on the law is solved with a penalty: slower slips settle
in few convex problems."""
FAILURES, LONGEST = 2, 4
"""Guesses in turn that fail before the next are left out, and most steps in which that is done: where boxes jam, nine
of ten guesses after two failures fail. The same for the rounds of a heap, as where a robot pushes boxes."""


@inlined
def leave(w: KernelWorld, rows: int) -> bool:
    """Leave what little is to be taken back of penetrations, or closed of gaps, where a load is; return if any is.

    Held rows are then met where nothing moves, without contradictions. The remaining corrections are in ``ahead``.
    """
    bias, left = w.row_bias, w.ahead
    found = False
    for k in range(rows):
        left[k] = 0.0
    k = 0
    while k < rows:
        if w.high[k] == math.inf and w.before[k] != 0.0 and abs(bias[k]) <= LEAST:
            left[k] = bias[k]
            w.slip[k] -= bias[k]
            found = found or bias[k] != 0.0
        k += 3 if w.mu[k] > 0.0 else 1
    return found


@inlined
def is_calm(w: KernelWorld, rows: int) -> bool:
    """Return whether no row with a load moves at the velocities of ``block_v``; their speeds are in ``slip``."""
    row_speeds(w, rows, w.block_v, w.slip, 0)
    k = 0
    while k < rows:
        size = 3 if w.mu[k] > 0.0 else 1
        if w.before[k] != 0.0:
            for j in range(k, k + size):
                if abs(w.slip[j]) > CALM:
                    return False
        k += size
    return True


@inlined
def take_up(w: KernelWorld, rows: int) -> None:
    """Take back again what `leave` left."""
    left = w.ahead
    for k in range(rows):
        w.slip[k] += left[k]


@inlined
def guesses_again(w: KernelWorld, root: int) -> bool:
    """Return whether an island's active set is guessed, or a heap gets rounds: both are left out after failures."""
    if w.unguessed[2 * root + 1] == 0:
        return True
    w.unguessed[2 * root + 1] -= 1
    return False


@inlined
def note_guess(w: KernelWorld, root: int, failed: bool, left: bool) -> None:
    """Count the guesses, or a heap's rounds, that failed in turn, and set in how many steps none is made.

    A guess that succeeds because of what `leave` left counts as a failure.
    """
    failures = w.unguessed[2 * root] + 1 if failed else (1 if left else 0)
    w.unguessed[2 * root] = failures
    w.unguessed[2 * root + 1] = min(LONGEST, max(0, failures - FAILURES + 1))


@compiled
def hold(w: KernelWorld, root: int, rows: int) -> int:
    """Find the velocities of an island, and the impulses x of its rows.

    Of the rows Y is J, of the trees u what `smooth_motion` left there. If it succeeds, u becomes the change of
    velocity; if not, all but working memory is as it was.

    Returns:
        How many sets of rows were tried, or negative how many rounds it took; 0 where it did not succeed.
    """
    g, speed, kept, stiffness = w.slip, w.block_v, w.v_ahead, w.g
    n = arrange(w, root, rows)
    if n == 0:
        return 0
    several, failed = w.island_next[root] >= 0, w.unguessed[2 * root] > 0
    # Between trees that move, biases are more than penetrations: see `correct_contact_point`.
    guessed = rows <= HEAP
    leaves = not several
    if not guessed or (several and failed):
        tree = root
        while tree >= 0:
            first = w.tree_dof[tree]
            at = w.block_first[w.tree_block[tree]]
            for d in range(first, w.tree_dof[tree + 1]):
                speed[at + d - first] = w.v_start[d]
            tree = w.island_next[tree]
        calm = is_calm(w, rows)
        # In a heap, it would seldom help.
        leaves = leaves or (guessed and calm)
        guessed = guessed or calm
        if not guessed and not guesses_again(w, root):
            return 0
    tree = root
    while tree >= 0:
        first, beyond = w.tree_dof[tree], w.tree_dof[tree + 1]
        for d in range(first, beyond):
            kept[d] = w.u[d]
        solve_forward(w, first, beyond)
        at = w.block_first[w.tree_block[tree]]
        for d in range(first, beyond):
            speed[at + d - first] = w.v_start[d] + w.u[d]
        tree = w.island_next[tree]
    row_speeds(w, rows, speed, g, 0)
    largest = 0.0
    for k in range(rows):
        g[k] += w.row_bias[k]
        largest = max(largest, abs(g[k]))
    compute_row_stiffness(w, root, rows)
    stiffen(w, rows)
    # As `solve` has it.
    tiny = 1e-11 * largest + 1e-14
    most = 0.0
    for k in range(rows):
        most = max(most, max(abs(w.before[k]), abs(g[k]) * stiffness[k] / STIFFNESS))
    most *= WILD
    fast = rows <= HEAP and largest > FAST
    done = 0
    if guessed and (not fast or not several or guesses_again(w, root)):
        left = False
        for attempt in range(2 if leaves else 1):
            left_before = left
            left = leaves and failed == (attempt == 0) and leave(w, rows)
            if attempt == 1 and left == left_before:
                break
            first_hold(w, rows)
            tried = try_states(w, root, rows, n, tiny, most)
            if left:
                take_up(w, rows)
            if tried > 0:
                done = attempt + tried
                break
        note_guess(w, root, done == 0, left)
    if done == 0 and fast:
        done = -solve_augmented(w, root, rows, n, tiny)
    if done == 0 and (rows <= HEAP or not guessed or guesses_again(w, root)):
        for k in range(rows):
            w.ahead[k] = w.row_bias[k]
        # At the velocities of the last step, that is, at rest where it was.
        tree = root
        while tree >= 0:
            first = w.tree_dof[tree]
            at = w.block_first[w.tree_block[tree]]
            for d in range(first, w.tree_dof[tree + 1]):
                speed[at + d - first] = -w.u[d]
            tree = w.island_next[tree]
        done = -go_round(w, root, rows, n, tiny, most)
        if rows > HEAP:
            note_guess(w, root, done == 0, False)
        if done == 0:
            for k in range(rows):
                w.row_bias[k], w.before[k] = w.ahead[k], w.last[w.slot[k]]
    tree = root
    while tree >= 0:
        first = w.tree_dof[tree]
        at = w.block_first[w.tree_block[tree]]
        for d in range(first, w.tree_dof[tree + 1]):
            w.u[d] = w.u[d] + speed[at + d - first] if done != 0 else kept[d]
        tree = w.island_next[tree]
    return done
