"""The attempts by which `augmented_newton` solves a tree: which one a step begins with, and which follows a failure."""

import math

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import ATTEMPT, LAST_ATTEMPT, SKIPPED, TURNS

RESTING, LIFTING, LEAVING, RELAXED, MOVING, BOUNDED, GUESSED, SWEPT = range(8)
"""Attempts: with a hard penalty, the same with one slow correction of all deep penetrations, which cannot contradict
each other where they have one normal, without any corrections of penetrations, also without slow returns of joints
beyond their limits, this with a soft penalty that grows, and with friction bounded by the normal impulses before each
round. The rounds of this one minimise convex functions, so they converge where friction jams a moving robot. The last
two make no rounds: guesses of the active set, and sweeps where these fail, too, which only come near the law."""
DEEP, LIFT = 0.003, 0.004
"""Penetrations [m] from which on `LIFTING` is tried, and its correction [m/s], for which joints need the force."""
LONGEST = 16
"""Most steps in which attempts that failed are skipped."""
SLOW = 0.5
"""Velocity [rad/s or m/s] of a dof below which `LIFTING` and `RELAXED` are tried: what falls needs `MOVING` anyway."""
RETURN = 0.1
"""Velocity [rad/s or m/s] of a joint beyond its limit from which on it is always made to return."""


@inlined
def leave_violations(w: KernelWorld, first: int, beyond: int, fastest: float) -> bool:
    """Leave violations that are corrected slower than `fastest`, since corrections contradict each other.

    Returns:
        Whether there are any from the first row on.
    """
    found = False
    for k in range(first, beyond):
        if -fastest < w.row_bias[k] < 0.0 and w.high[k] == math.inf and w.low[k] == 0.0:
            w.row_bias[k] = 0.0
            found = True
    return found


@inlined
def lift_out(w: KernelWorld, first: int, beyond: int, contacts: int) -> bool:
    """Correct all penetrations at one slow speed at most, if any is deep; return whether one is."""
    found = False
    for i in range(contacts):
        found = found or w.contact_gap[w.index[i]] < -DEEP
    for k in range(first, beyond):
        if found and w.row_bias[k] < -LIFT and w.high[k] == math.inf and w.low[k] == 0.0:
            w.row_bias[k] = -LIFT
    return found


@inlined
def first_attempt(w: KernelWorld, tree: int, joint_rows: int, rows: int, contacts: int) -> int:
    """Return the attempt that a step begins with: that of the last step if the ones before failed several times."""
    at = ATTEMPT * tree
    attempt = int(w.attempt[at + LAST_ATTEMPT]) if w.attempt[at + SKIPPED] > 0 else RESTING
    if attempt == SWEPT:
        # Rounds are tried in each step, but no guesses.
        return attempt
    if attempt == LIFTING and not lift_out(w, joint_rows, rows, contacts):
        attempt = RESTING
    if attempt >= LEAVING:
        leave_violations(w, joint_rows, rows, math.inf)
    if attempt >= RELAXED:
        leave_violations(w, 0, joint_rows, RETURN)
    return attempt


@inlined
def is_slow(w: KernelWorld, tree: int) -> bool:
    """Return whether all dofs of a tree are slow, so that attempts for robots at rest make sense."""
    for d in range(w.tree_dof[tree], w.tree_dof[tree + 1]):  # noqa: SIM110
        if not abs(w.v_start[d]) < SLOW:
            return False
    return True


@inlined
def next_attempt(w: KernelWorld, tree: int, attempt: int, joint_rows: int, rows: int, contacts: int) -> int:
    """Return the attempt that follows a failure, and leave out the corrections that it does not make."""
    if attempt == RESTING and is_slow(w, tree) and lift_out(w, joint_rows, rows, contacts):
        return LIFTING
    if attempt < LEAVING and leave_violations(w, joint_rows, rows, math.inf):
        return LEAVING
    return RELAXED if leave_violations(w, 0, joint_rows, RETURN) and is_slow(w, tree) else MOVING


@inlined
def remember_attempt(w: KernelWorld, tree: int, first: int, last: int) -> None:
    """Choose for how many steps attempts are skipped that failed in this step, more the more often they failed.

    So a robot at rest or in a fall does not attempt in vain, in each step, what failed in many steps before.

    Args:
        w: the world's arrays.
        tree: which.
        first: first attempt of this step.
        last: last one.
    """
    at = ATTEMPT * tree
    if last != w.attempt[at + LAST_ATTEMPT]:
        w.attempt[at + LAST_ATTEMPT] = last
        w.attempt[at + TURNS] = w.attempt[at + SKIPPED] = 0
    elif first == last:
        w.attempt[at + SKIPPED] = max(0, w.attempt[at + SKIPPED] - 1)
    else:
        w.attempt[at + TURNS] += 1
        w.attempt[at + SKIPPED] = min(w.attempt[at + TURNS], LONGEST) if last != BOUNDED else 0
