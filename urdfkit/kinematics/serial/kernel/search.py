"""Search for configurations that reach a target: descents from the seed, then from random configurations."""

import math
from typing import Any

from urdfkit.kinematics.serial.kernel.chain_forward import AXIS, Chain, geometric_jacobian, place
from urdfkit.kinematics.serial.kernel.compilation import Floats, Integers, compiled, inlined, shifted, stack
from urdfkit.kinematics.serial.kernel.damped_step import volume
from urdfkit.kinematics.serial.kernel.descent import LIMIT, descend
from urdfkit.kinematics.serial.kernel.random_stream import first_state, next_state, uniform

FIRST, NEAREST, MANIPULABILITY, EVERY = 0, 1, 2, 3
"""Which solution is kept: the first, that nearest to the seed, that with the largest manipulability, or all."""
ROW = 5
"""Numbers of a solution after its configuration: distance [m], angle [rad], whether it reaches the target, the number
of restarts, and its rank: the smallest is kept."""
TURN = 2.0 * math.pi
DIFFERENT = 1e-2
"""Difference [rad or m] of a variable from which two configurations are two solutions."""
ITERATIONS, PATIENCE, FALL = 40, 5, 0.5
HEAVY = 30.0
"""Weight of a metre of distance, relative to a radian, on the way to the nearest configuration."""
SLACK = 1e-5
"""Distance [m] for which the nearest configuration is nearer by a radian."""


@inlined
def nearest_turn(value: float, seed: float, lower: float, upper: float) -> float:
    """Return the value plus whole turns that is nearest to the seed, within the limits."""
    value += TURN * math.floor((seed - value) / TURN + 0.5)
    if value > upper:
        value -= TURN * math.ceil((value - upper) / TURN)
    if value < lower:
        value += TURN * math.ceil((lower - value) / TURN)
    return min(max(value, lower), upper)


@inlined
def near_seed(q: Floats, seed: Floats, size: int, limits: Floats) -> None:
    """Move each variable by whole turns, where they change nothing, to the turn nearest to the seed."""
    for j in range(size):
        if limits[LIMIT * j + 5] > 0.0:
            q[j] = nearest_turn(q[j], seed[j], limits[LIMIT * j], limits[LIMIT * j + 1])


@inlined
def is_different(q: Floats, row: Floats, size: int, limits: Floats) -> bool:
    """Return whether two configurations are two solutions; whole turns of a variable are ignored."""
    for j in range(size):
        difference = q[j] - row[j]
        if limits[LIMIT * j + 5] > 0.0:
            difference -= TURN * math.floor(difference / TURN + 0.5)
        if abs(difference) > DIFFERENT:
            return True
    return False


@inlined
def rank(chain: Chain, q: Floats, seed: Floats, prefer: int, angular: float, work: Floats) -> float:
    """Return a number that is smaller for the better of two solutions."""
    _, _, count, size = chain
    if prefer == MANIPULABILITY:
        pose = stack(12)
        jacobian = shifted(work, AXIS * count)
        place(chain, q, pose, work)
        geometric_jacobian(chain, pose, work, 1, 6, jacobian)
        return -volume(jacobian, size, 6 if angular > 0.0 else 3)
    total = 0.0
    for j in range(size):
        total += (q[j] - seed[j]) * (q[j] - seed[j])
    return total


@inlined
def start(attempt: int, state: Any, seed: Floats, size: int, limits: Floats, q: Floats) -> Any:
    """Write the start of a descent: the seed, within the limits, then random ones; return the next random state."""
    for j in range(size):
        if attempt == 0:
            q[j] = seed[j]
            if limits[LIMIT * j + 5] > 0.0:
                q[j] = nearest_turn(q[j], q[j], limits[LIMIT * j], limits[LIMIT * j + 1])
            q[j] = min(max(q[j], limits[LIMIT * j]), limits[LIMIT * j + 1])
        else:
            state = next_state(state)
            lower = limits[LIMIT * j + 2]
            q[j] = lower + uniform(state) * (limits[LIMIT * j + 3] - lower)
            if limits[LIMIT * j + 4] > 0.0:
                q[j] += seed[j]
    return state


@compiled
def approach(
    chain: Chain,
    limits: Floats,
    goal: Floats,
    state: Any,
    seed: Floats,
    angular: float,
    starts: int,
    row: Floats,
    work: Floats,
) -> None:
    """Write the configuration nearest to a target that cannot be reached: by distance first, then by angle.

    Each descent ends with the distance alone, so that its weight does not shift the minimum.

    Args:
        chain: see `chain_forward.Chain`.
        limits: see `descent.LIMIT`.
        goal: see `descent.pose_error`.
        state: random state of the target.
        seed: see `search`.
        angular: weight of the angle; 0 if it does not matter.
        starts: number of descents.
        row: written: see `search`.
        work: memory for ``AXIS * count + 10 * size`` numbers.
    """
    size = chain[3]
    q = work
    memory = shifted(work, size)
    best = math.inf
    for attempt in range(starts):
        state = start(attempt, state, seed, size, limits, q)
        descent = (chain, limits, goal, q, memory)
        # Every other descent ignores the angle, which can hide the nearest position.
        weight = angular if attempt % 2 == 0 else 0.0
        descend(*descent, 2.0, weight, 0.0, 0.0, ITERATIONS, PATIENCE, FALL)
        if weight > 0.0:
            descend(*descent, HEAVY, angular, 0.0, 0.0, 2 * ITERATIONS, 10, 0.99)
        distance2, angle2, _ = descend(*descent, 1.0, 0.0, 0.0, 0.0, 2 * ITERATIONS, PATIENCE, 1.0 - 1e-9)
        value = math.sqrt(distance2) + (SLACK * math.sqrt(angle2) if angular > 0.0 else 0.0)
        if value < best:
            best = value
            near_seed(q, seed, size, limits)
            for j in range(size):
                row[j] = q[j]
            row[size] = math.sqrt(distance2)
            row[size + 1] = math.sqrt(angle2)
            row[size + 2] = 0.0
            row[size + 4] = value


@inlined
def search(
    chain: Chain,
    limits: Floats,
    goal: Floats,
    bits: Integers,
    first: int,
    width: int,
    seed: Floats,
    options: Floats,
    rows: Floats,
    work: Floats,
) -> None:
    """Write the solutions for one target: the best one, or all.

    Args:
        chain: see `chain_forward.Chain`.
        limits: see `descent.LIMIT`.
        goal: see `descent.pose_error`.
        bits: see `random_stream.first_state`.
        first: index of the target's first number in `bits`.
        width: number of its numbers.
        seed: configuration of the first descent.
        options: weights of distance and angle, their tolerances, number of restarts, which solution is kept, number of
            rows, number of restarts after the first solution, number of the random stream,
            number of descents to the configuration nearest to a target that is not reached.
        rows: written: ``size + ROW`` numbers per solution.
        work: memory for ``AXIS * count + 10 * size`` numbers.
    """
    size = chain[3]
    linear = options[0]
    angular = options[1]
    distance = options[2]
    angle = options[3]
    restarts = int(options[4])
    prefer = int(options[5])
    capacity = int(options[6])
    more = int(options[7])
    length = size + ROW
    q = work
    memory = shifted(work, size)
    state = first_state(options[8], bits, first, width)
    for k in range(capacity * length):
        rows[k] = 0.0
    found = 0
    best = math.inf
    last = restarts
    attempt = 0
    while attempt <= last:
        state = start(attempt, state, seed, size, limits, q)
        distance2, angle2, cost = descend(
            *(chain, limits, goal, q, memory, linear, angular, distance, angle, ITERATIONS, PATIENCE, FALL)
        )
        near_seed(q, seed, size, limits)
        reached = distance2 <= distance * distance and (angular == 0.0 or angle2 <= angle * angle)
        row = rows
        kept = False
        if reached:
            value = 0.0 if prefer == FIRST else rank(chain, q, seed, prefer, angular, memory)
            if prefer == EVERY:
                kept = True
                for k in range(found):
                    if not is_different(q, shifted(rows, length * k), size, limits):
                        kept = False
                row = shifted(rows, length * found)
            elif found == 0:
                kept = True
                last = attempt if prefer == FIRST else min(restarts, attempt + more)
            else:
                kept = value < best
            if kept:
                best = value
                found += 1
        elif found == 0 and cost < best:
            kept = True
            best = cost
        if kept:
            for j in range(size):
                row[j] = q[j]
            row[size] = math.sqrt(distance2)
            row[size + 1] = math.sqrt(angle2)
            row[size + 2] = 1.0 if reached else 0.0
            row[size + 3] = float(attempt)
            row[size + 4] = best
        if prefer == EVERY and found == capacity:
            break
        attempt += 1
    if found == 0:
        if options[9] > 0.0:
            state = first_state(options[8], bits, first, width)
            approach(chain, limits, goal, state, seed, angular, int(options[9]), rows, work)
        rows[size + 3] = float(restarts)
