"""Criteria for sleep: a tree is at rest, and neither targets nor forces act on it.

A tree is at rest if it moved, in `PATIENCE` or since it came to rest, no farther than it would at a speed of `QUIET`
(`TURNING`), and was never faster than `LOUD`. So a body in a heap is at rest even if it jitters a little where
contacts open and close.
"""

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.constraints.joint_servos import is_servo
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import DT, OBSERVED

QUIET = 1e-4
"""Speed [m/s, rad/s] below which, on the whole, a dof counts as at rest: MuJoCo's ``sleep_tolerance``."""
TURNING = 5e-3
"""The same for the turning of a free body, which nothing brakes where it lies on two points [rad/s].

MuJoCo, too, allows small bodies to turn faster, ODE 0.01 rad/s.
"""
LOUD = 1e-2
"""Speed [m/s, rad/s] of a dof that is not at rest, however short: ODE's thresholds for bodies to be disabled."""
LOUD_TURNING = 5e-2
"""The same for the turning of a free body [rad/s]: a corner of a brick goes at a tenth of that [m/s]."""
PATIENCE = 0.5
"""How long an island is at rest before it sleeps [s]."""
TARGETS = 10
"""Targets of each dof that are remembered."""


@inlined
def target_of(w: KernelWorld, d: int, k: int) -> float:
    """Return the k-th of the targets of a dof."""
    if k == 0:
        return float(w.motor_velocity[d])
    if k == 1:
        return float(w.motor_effort[d])
    if k == 2:
        return float(w.applied[d])
    if k == 3:
        return float(w.position_target[d])
    if k == 4:
        return float(w.velocity_target[d])
    if k == 5:
        return float(w.kp[d])
    if k == 6:
        return float(w.kd[d])
    if k == 7:
        return float(w.ki[d])
    if k == 8:
        return float(w.approach_rate[d])
    return float(w.servo_effort[d])


@inlined
def is_free_body(w: KernelWorld, tree: int) -> bool:
    """Return whether a tree is one body that nothing holds."""
    return bool(w.tree_body[tree + 1] - w.tree_body[tree] == 1 and w.tree_floats[tree] != 0)


@inlined
def is_left_alone(w: KernelWorld, tree: int) -> bool:
    """Return whether a tree may sleep, and no target or force acts on it that could move it."""
    if w.sleeps[tree] == 0:
        return False
    # The last dofs first: the motors of a robot come after the dofs of its base.
    for d in range(w.tree_dof[tree + 1] - 1, w.tree_dof[tree] - 1, -1):
        if w.applied[d] != 0.0 or w.motor_velocity[d] != 0.0 or is_servo(w, d):
            return False
    return True


@inlined
def is_quiet(w: KernelWorld, tree: int) -> bool:
    """Return whether a tree hardly moves.

    How far each dof has gone since the tree began to be at rest is kept in ``strayed``.
    """
    dt = w.numbers[DT]
    still = w.still[OBSERVED * tree]
    first, free = w.tree_dof[tree], is_free_body(w, tree)
    for d in range(first, w.tree_dof[tree + 1]):
        w.strayed[d] = (w.strayed[d] if still > 0.0 else 0.0) + dt * w.v[d]
    for d in range(first, w.tree_dof[tree + 1]):
        turns = free and d >= first + 3
        slow = TURNING if turns else QUIET
        if not abs(w.v[d]) < (LOUD_TURNING if turns else LOUD) or not abs(w.strayed[d]) < slow * max(PATIENCE, still):
            return False
    return True
