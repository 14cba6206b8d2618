"""What every row of an island is taken to do, and what the velocities and impulses that follow say about that."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.island_solver.coulomb_direction import STIFFNESS, slide, strike
from urdfkit.sim.engine.solver.row_states import AT_HIGH, AT_LOW, HOLDS


@inlined
def first_hold(floats: Any, integers: Any, rows: int) -> None:
    """Guess from the last step's impulses what every row does."""
    g = field(floats, integers, At.slip)
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
            state[k + 1] = state[k + 2] = state[k]
            size = math.sqrt(before[k + 1] ** 2 + before[k + 2] ** 2)
            if before[k] > 0.0 and size >= (1.0 - 1e-9) * mu[k] * before[k]:
                a, b = -before[k + 1] / size, -before[k + 2] / size
                slide(floats, integers, k, a, b, max(0.0, a * g[k + 1] + b * g[k + 2]), before[k])
            k += 3
            continue
        if low[k] == 0.0:
            state[k] = HOLDS if before[k] > 0.0 else AT_LOW
        elif before[k] >= high[k]:
            state[k] = AT_HIGH
        elif before[k] <= low[k]:
            state[k] = AT_LOW
        k += 1


@inlined
def revise_contact(floats: Any, integers: Any, k: int, tiny: float, least: float) -> None:
    """Change what the law forbids a contact, or take the direction of its slip anew."""
    w = field(floats, integers, At.y)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    stiffness = field(floats, integers, At.g)
    near = field(floats, integers, At.near_x)
    state = field(integers, integers, At.state)
    doing = state[k]
    if doing == AT_LOW:
        if w[k] < -tiny:
            strike(floats, integers, k, w[k], w[k + 1], w[k + 2], STIFFNESS / stiffness[k])
    elif x[k] < 0.0:
        state[k] = state[k + 1] = state[k + 2] = AT_LOW
    elif doing == HOLDS:
        size = math.sqrt(x[k + 1] ** 2 + x[k + 2] ** 2)
        if size > mu[k] * x[k] * (1.0 + 1e-9) + least:
            # It will slip about as fast as what is too much for it would have kept it from.
            left = (size - mu[k] * x[k]) * STIFFNESS / max(stiffness[k + 1], stiffness[k + 2])
            slide(floats, integers, k, -x[k + 1] / size, -x[k + 2] / size, left, x[k])
    else:
        a, b = near[k + 1], near[k + 2]
        forward = a * w[k + 1] + b * w[k + 2]
        if forward < -tiny:
            state[k] = state[k + 1] = state[k + 2] = HOLDS
        else:
            slide(floats, integers, k, a, b, forward, x[k])


@compiled
def revise(floats: Any, integers: Any, rows: int, tiny: float, least: float) -> bool:
    """Change what the law forbids at the velocities y of the rows; return whether something had to change."""
    w = field(floats, integers, At.y)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    state = field(integers, integers, At.state)
    changed = False
    k = 0
    while k < rows:
        doing = state[k]
        if mu[k] > 0.0:
            revise_contact(floats, integers, k, tiny, least)
            changed = changed or state[k] != doing
            k += 3
            continue
        if doing == HOLDS:
            if x[k] < low[k]:
                state[k] = AT_LOW
            elif x[k] > high[k]:
                state[k] = AT_HIGH
        else:
            if (doing == AT_LOW and w[k] < -tiny) or (doing == AT_HIGH and w[k] > tiny):
                state[k] = HOLDS
        changed = changed or state[k] != doing
        k += 1
    return changed


@compiled
def start_over(floats: Any, integers: Any, rows: int, n: int) -> None:
    """Begin with the velocities that are without impulses, also of the rows, and with the impulses of the last step."""
    speed = field(floats, integers, At.block_v)
    g = field(floats, integers, At.slip)
    w = field(floats, integers, At.y)
    before = field(floats, integers, At.before)
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    state = field(integers, integers, At.state)
    k = 0
    while k < rows:
        doing = state[k]
        if mu[k] > 0.0:
            x[k] = 0.0 if doing == AT_LOW else before[k]
            x[k + 1] = before[k + 1] if doing == HOLDS else 0.0
            x[k + 2] = before[k + 2] if doing == HOLDS else 0.0
            k += 3
            continue
        x[k] = before[k] if doing == HOLDS else (low[k] if doing == AT_LOW else high[k])
        k += 1
    for k in range(rows):
        w[k] = g[k]
    for d in range(n):
        speed[d] = 0.0
