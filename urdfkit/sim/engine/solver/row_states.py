"""Active set: the assumed state of every row, and its revision from the resulting impulses.

A sliding contact is described by the direction of its slip, a unit vector d in the tangent plane: friction is -mu·x·d.
``slip`` contains d at the two tangent rows, and at the normal's row the slip across d per impulse across d, which
rotates d.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import field, inlined

HOLDS, AT_LOW, AT_HIGH, SLIDES = range(4)
"""Assumed state of a row, or of a contact at its normal row."""


@inlined
def result(rows: int, A: Any, g: Any, x: Any, k: int) -> float:
    """Return w of row k."""
    total: float = g[k]
    for j in range(rows):
        total += A[k * rows + j] * x[j]
    return total


@inlined
def slip_stiffness(speed: float, friction: float, stiffness: float) -> float:
    """Return the slip across its direction that comes with an impulse across it [m/s per N·s].

    An impulse there turns friction, and the slip, whose `speed` stays, turns with it. Where there is no friction to
    turn, it may hardly be any.
    """
    most = 1e9 * stiffness
    return min(max(0.0, speed) / friction, most) if friction > 0.0 else most


@inlined
def classify_impact(floats: Any, integers: Any, rows: int, k: int, normal: float, first: float, second: float) -> None:
    """Choose from the closing velocities of an open contact whether it will slide."""
    A = field(floats, integers, At.A)
    mu = field(floats, integers, At.mu)
    slip = field(floats, integers, At.slip)
    state = field(integers, integers, At.state)
    speed = math.sqrt(first * first + second * second)
    friction = -mu[k] * normal / A[k * rows + k]
    left = speed - friction * min(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
    state[k] = HOLDS
    if left > 0.0:
        state[k] = SLIDES
        slip[k], slip[k + 1], slip[k + 2] = (
            slip_stiffness(left, friction, A[k * rows + k]),
            first / speed,
            second / speed,
        )


@inlined
def initial_active_set(floats: Any, integers: Any, rows: int, tiny: float) -> None:
    """Choose the state of every row from the impulses of the last step."""
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    before = field(floats, integers, At.before)
    slip = field(floats, integers, At.slip)
    state = field(integers, integers, At.state)
    k = 0
    while k < rows:
        if mu[k] > 0.0:
            state[k] = HOLDS if before[k] > 0.0 or g[k] < -tiny else AT_LOW
            size = math.sqrt(before[k + 1] * before[k + 1] + before[k + 2] * before[k + 2])
            if size > 0.0 and size >= (1.0 - 1e-9) * mu[k] * before[k]:
                state[k] = SLIDES
                a, b = -before[k + 1] / size, -before[k + 2] / size
                speed = a * result(rows, A, g, before, k + 1) + b * result(rows, A, g, before, k + 2)
                slip[k], slip[k + 1], slip[k + 2] = slip_stiffness(speed, size, A[k * rows + k]), a, b
            elif state[k] == HOLDS and before[k] == 0.0:
                classify_impact(floats, integers, rows, k, g[k], g[k + 1], g[k + 2])
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        state[k] = HOLDS
        if low[k] == 0.0:
            state[k] = HOLDS if before[k] > 0.0 or g[k] < 0.0 else AT_LOW
        elif low[k] > -math.inf:
            if before[k] >= high[k]:
                state[k] = AT_HIGH
            elif before[k] <= low[k]:
                state[k] = AT_LOW
        k += 1


@inlined
def active_set_from_impulses(floats: Any, integers: Any, rows: int, x: Any) -> None:
    """Choose the state of every row from approximate impulses."""
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    slip = field(floats, integers, At.slip)
    state = field(integers, integers, At.state)
    k = 0
    while k < rows:
        state[k] = HOLDS
        if mu[k] > 0.0:
            if x[k] <= 0.0:
                state[k] = AT_LOW
            else:
                # The impulse that would stop the slip, if it alone changed: inside the cone it holds.
                stiffness = max(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
                first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                a, b = first - stiffness * x[k + 1], second - stiffness * x[k + 2]
                size, most = math.sqrt(a * a + b * b), mu[k] * x[k]
                if size > stiffness * most:
                    state[k] = SLIDES
                    a, b = a / size, b / size
                    slip[k], slip[k + 1], slip[k + 2] = (
                        slip_stiffness(first * a + second * b, most, A[k * rows + k]),
                        a,
                        b,
                    )
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        if x[k] <= low[k]:
            state[k] = AT_LOW
        elif x[k] >= high[k]:
            state[k] = AT_HIGH
        k += 1


@inlined
def rotate_slip_directions(floats: Any, integers: Any, rows: int, x: Any, tiny: float) -> bool:
    """Rotate the slip directions by the impulses across them; return whether all velocities satisfy the law.

    Before, x has the impulse across at the first tangent's row; afterwards, it has friction along the new direction.
    """
    A = field(floats, integers, At.A)
    mu = field(floats, integers, At.mu)
    slip = field(floats, integers, At.slip)
    state = field(integers, integers, At.state)
    there = True
    k = 0
    while k < rows:
        if mu[k] > 0.0:
            if state[k] == SLIDES and x[k] >= 0.0:
                most, across = mu[k] * x[k], x[k + 1]
                a, b = slip[k + 1], slip[k + 2]
                size = math.sqrt(most * most + across * across)
                if size > 0.0:
                    a, b = (most * a - across * b) / size, (most * b + across * a) / size
                slip[k + 1], slip[k + 2] = a, b
                x[k + 1], x[k + 2] = -most * a, -most * b
                # The impulse went straight where it should have gone round.
                if (size - most) * A[k * rows + k] > tiny:
                    there = False
            k += 3
        else:
            k += 1
    return there


@inlined
def revise_active_set(floats: Any, integers: Any, rows: int, x: Any, tiny: float) -> bool:
    """Change the rows whose state contradicts the law; return whether none had to change."""
    A = field(floats, integers, At.A)
    g = field(floats, integers, At.g)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    slip = field(floats, integers, At.slip)
    state = field(integers, integers, At.state)
    right = True
    k = 0
    while k < rows:
        doing = state[k]
        if mu[k] > 0.0:
            if doing == AT_LOW:
                normal = result(rows, A, g, x, k)
                if normal < -tiny:
                    first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                    classify_impact(floats, integers, rows, k, normal, first, second)
            elif x[k] < 0.0:
                state[k] = AT_LOW
            elif doing == HOLDS:
                size = math.sqrt(x[k + 1] * x[k + 1] + x[k + 2] * x[k + 2])
                if size > mu[k] * x[k] * (1.0 + 1e-9):
                    state[k] = SLIDES
                    slip[k], slip[k + 1], slip[k + 2] = 0.0, -x[k + 1] / size, -x[k + 2] / size
            else:
                a, b = slip[k + 1], slip[k + 2]
                first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                speed = first * a + second * b
                if speed < -tiny:
                    state[k] = HOLDS
                elif abs(second * a - first * b) > 1e-9 * speed + 1e-3 * tiny:
                    right = False
                slip[k] = slip_stiffness(speed, mu[k] * x[k], A[k * rows + k])
            if state[k] != doing:
                right = False
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        if doing == HOLDS:
            if x[k] < low[k]:
                state[k] = AT_LOW
            elif x[k] > high[k]:
                state[k] = AT_HIGH
        else:
            w = result(rows, A, g, x, k)
            if (doing == AT_LOW and w < -tiny) or (doing == AT_HIGH and w > tiny):
                state[k] = HOLDS
        if state[k] != doing:
            right = False
        k += 1
    return right
