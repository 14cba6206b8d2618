"""Wheel odometry: a planar pose integrated from the positions of a robot's joints, at a fixed rate.

`Odometer` starts it and reads it. `EncoderOdometry` of the plugins computes the same in Python, between two updates.
"""

import math

from urdfkit.sim.engine.compilation import compiled
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.math.elementary_functions import sine_cosine
from urdfkit.sim.engine.simulation_memory import (
    ANGLE_SHARE,
    AXLES,
    BEFORE,
    DISTANCE,
    ENCODER,
    ENCODERS,
    FIRST_COORDINATE,
    FOLLOWS_ARC,
    FORWARD,
    FORWARD_SHARE,
    HEADING,
    LAST_POSITION,
    LAST_UPDATE,
    LEFT,
    LEFT_SHARE,
    NEXT_UPDATE,
    ODOMETER,
    ODOMETRY,
    PERIOD,
    TURN_SHARE,
    TURNED,
    X,
    Y,
)

ROUNDING = 1e-6
"""Tolerance of rounding, as a fraction of a step: that of `PeriodicSteps`."""
STRAIGHT = 1e-6
"""Turn below which an arc is its chord [rad]."""


@compiled
def update_odometry(w: KernelWorld, tree: int, step: int) -> None:
    """Update the pose of a robot whose odometry is due at a step."""
    counts, found = ODOMETER * tree, ODOMETRY * tree
    period = w.odometry[found + PERIOD]
    tick = math.floor((step + ROUNDING) / period)
    before = math.ceil((tick - 1) * period - ROUNDING)
    w.odometer[counts + BEFORE] = max(w.odometer[counts + LAST_UPDATE], before)  # later if the robot slept
    w.odometer[counts + LAST_UPDATE] = step
    w.odometer[counts + NEXT_UPDATE] = math.ceil((tick + 1) * period - ROUNDING)
    forward = left = turn = angle = 0.0
    for k in range(w.odometer[counts]):
        encoder = (tree * ENCODERS + k) * ENCODER
        last = w.encoder[encoder + LAST_POSITION]
        now = w.s[w.tree_s[tree] + w.odometer[counts + FIRST_COORDINATE + k]]
        forward += w.encoder[encoder + FORWARD_SHARE] * (now - last)
        left += w.encoder[encoder + LEFT_SHARE] * (now - last)
        turn += w.encoder[encoder + TURN_SHARE] * (now - last)
        angle += w.encoder[encoder + ANGLE_SHARE] * 0.5 * (now + last)
        w.encoder[encoder + LAST_POSITION] = now
    if w.odometry[found + AXLES] != 0.0:
        sine, cosine = sine_cosine(angle)
        turn += forward * sine / cosine / w.odometry[found + AXLES]
    length = 1.0
    if w.odometer[counts + FOLLOWS_ARC] != 0 and abs(turn) > STRAIGHT:
        sine, _ = sine_cosine(0.5 * turn)
        length = sine / (0.5 * turn)
    sine, cosine = sine_cosine(w.odometry[found + HEADING] + 0.5 * turn)
    dx, dy = length * (forward * cosine - left * sine), length * (forward * sine + left * cosine)
    w.odometry[found + X] += dx
    w.odometry[found + Y] += dy
    w.odometry[found + HEADING] += turn
    w.odometry[found + FORWARD], w.odometry[found + LEFT], w.odometry[found + TURNED] = forward, left, turn
    w.odometry[found + DISTANCE] = math.sqrt(dx * dx + dy * dy)


@compiled
def update_odometry_at_rest(w: KernelWorld, tree: int, step: int) -> None:
    """Update the pose of a robot at rest whenever it is due up to a step, so that its velocities become zero."""
    at = ODOMETER * tree
    while w.odometer[at] != 0 and w.odometer[at + NEXT_UPDATE] <= step:
        update_odometry(w, tree, w.odometer[at + NEXT_UPDATE])
