"""Active set: the assumed state of every row, and its revision from the resulting impulses.

A sliding contact is described by the direction of its slip, a unit vector d in the tangent plane: friction is -mu·x·d.
``slip`` contains d at the two tangent rows, and at the normal's row the slip across d per impulse across d, which
rotates d.
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.kernel_world import KernelWorld

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
def classify_impact(w: KernelWorld, rows: int, k: int, normal: float, first: float, second: float) -> None:
    """Choose from the closing velocities of an open contact whether it will slide."""
    speed = math.sqrt(first * first + second * second)
    friction = -w.mu[k] * normal / w.A[k * rows + k]
    left = speed - friction * min(w.A[(k + 1) * rows + k + 1], w.A[(k + 2) * rows + k + 2])
    w.state[k] = HOLDS
    if left > 0.0:
        w.state[k] = SLIDES
        w.slip[k], w.slip[k + 1], w.slip[k + 2] = (
            slip_stiffness(left, friction, w.A[k * rows + k]),
            first / speed,
            second / speed,
        )


@inlined
def initial_active_set(w: KernelWorld, rows: int, tiny: float) -> None:
    """Choose the state of every row from the impulses of the last step."""
    g, before, state = w.g, w.before, w.state
    k = 0
    while k < rows:
        if w.mu[k] > 0.0:
            state[k] = HOLDS if before[k] > 0.0 or g[k] < -tiny else AT_LOW
            size = math.sqrt(before[k + 1] * before[k + 1] + before[k + 2] * before[k + 2])
            if size > 0.0 and size >= (1.0 - 1e-9) * w.mu[k] * before[k]:
                state[k] = SLIDES
                a, b = -before[k + 1] / size, -before[k + 2] / size
                speed = a * result(rows, w.A, g, before, k + 1) + b * result(rows, w.A, g, before, k + 2)
                w.slip[k], w.slip[k + 1], w.slip[k + 2] = slip_stiffness(speed, size, w.A[k * rows + k]), a, b
            elif state[k] == HOLDS and before[k] == 0.0:
                classify_impact(w, rows, k, g[k], g[k + 1], g[k + 2])
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        state[k] = HOLDS
        if w.low[k] == 0.0:
            state[k] = HOLDS if before[k] > 0.0 or g[k] < 0.0 else AT_LOW
        elif w.low[k] > -math.inf:
            if before[k] >= w.high[k]:
                state[k] = AT_HIGH
            elif before[k] <= w.low[k]:
                state[k] = AT_LOW
        k += 1


@inlined
def active_set_from_impulses(w: KernelWorld, rows: int, x: Any) -> None:
    """Choose the state of every row from approximate impulses."""
    state = w.state
    k = 0
    while k < rows:
        state[k] = HOLDS
        if w.mu[k] > 0.0:
            if x[k] <= 0.0:
                state[k] = AT_LOW
            else:
                # The impulse that would stop the slip, if it alone changed: inside the cone it holds.
                stiffness = max(w.A[(k + 1) * rows + k + 1], w.A[(k + 2) * rows + k + 2])
                first, second = result(rows, w.A, w.g, x, k + 1), result(rows, w.A, w.g, x, k + 2)
                a, b = first - stiffness * x[k + 1], second - stiffness * x[k + 2]
                size, most = math.sqrt(a * a + b * b), w.mu[k] * x[k]
                if size > stiffness * most:
                    state[k] = SLIDES
                    a, b = a / size, b / size
                    w.slip[k], w.slip[k + 1], w.slip[k + 2] = (
                        slip_stiffness(first * a + second * b, most, w.A[k * rows + k]),
                        a,
                        b,
                    )
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        if x[k] <= w.low[k]:
            state[k] = AT_LOW
        elif x[k] >= w.high[k]:
            state[k] = AT_HIGH
        k += 1


@inlined
def rotate_slip_directions(w: KernelWorld, rows: int, x: Any, tiny: float) -> bool:
    """Rotate the slip directions by the impulses across them; return whether all velocities satisfy the law.

    Before, x has the impulse across at the first tangent's row; afterwards, it has friction along the new direction.
    """
    there = True
    k = 0
    while k < rows:
        if w.mu[k] > 0.0:
            if w.state[k] == SLIDES and x[k] >= 0.0:
                most, across = w.mu[k] * x[k], x[k + 1]
                a, b = w.slip[k + 1], w.slip[k + 2]
                size = math.sqrt(most * most + across * across)
                if size > 0.0:
                    a, b = (most * a - across * b) / size, (most * b + across * a) / size
                w.slip[k + 1], w.slip[k + 2] = a, b
                x[k + 1], x[k + 2] = -most * a, -most * b
                # The impulse went straight where it should have gone round.
                if (size - most) * w.A[k * rows + k] > tiny:
                    there = False
            k += 3
        else:
            k += 1
    return there


@inlined
def revise_active_set(w: KernelWorld, rows: int, x: Any, tiny: float) -> bool:
    """Change the rows whose state contradicts the law; return whether none had to change."""
    A, state = w.A, w.state
    right = True
    k = 0
    while k < rows:
        doing = state[k]
        if w.mu[k] > 0.0:
            if doing == AT_LOW:
                normal = result(rows, A, w.g, x, k)
                if normal < -tiny:
                    first, second = result(rows, A, w.g, x, k + 1), result(rows, A, w.g, x, k + 2)
                    classify_impact(w, rows, k, normal, first, second)
            elif x[k] < 0.0:
                state[k] = AT_LOW
            elif doing == HOLDS:
                size = math.sqrt(x[k + 1] * x[k + 1] + x[k + 2] * x[k + 2])
                if size > w.mu[k] * x[k] * (1.0 + 1e-9):
                    state[k] = SLIDES
                    w.slip[k], w.slip[k + 1], w.slip[k + 2] = 0.0, -x[k + 1] / size, -x[k + 2] / size
            else:
                a, b = w.slip[k + 1], w.slip[k + 2]
                first, second = result(rows, A, w.g, x, k + 1), result(rows, A, w.g, x, k + 2)
                speed = first * a + second * b
                if speed < -tiny:
                    state[k] = HOLDS
                elif abs(second * a - first * b) > 1e-9 * speed + 1e-3 * tiny:
                    right = False
                w.slip[k] = slip_stiffness(speed, w.mu[k] * x[k], A[k * rows + k])
            if state[k] != doing:
                right = False
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        if doing == HOLDS:
            if x[k] < w.low[k]:
                state[k] = AT_LOW
            elif x[k] > w.high[k]:
                state[k] = AT_HIGH
        else:
            off = result(rows, A, w.g, x, k)
            if (doing == AT_LOW and off < -tiny) or (doing == AT_HIGH and off > tiny):
                state[k] = HOLDS
        if state[k] != doing:
            right = False
        k += 1
    return right
