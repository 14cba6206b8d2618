"""Revision of an active set: rows whose velocity or impulse contradicts their state change it."""

import math

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.island_solver.coulomb_direction import STIFFNESS, slide, strike
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.solver.row_states import AT_HIGH, AT_LOW, HOLDS


@inlined
def first_hold(w: KernelWorld, rows: int) -> None:
    """Guess from the last step's impulses what every row does."""
    before, state = w.before, w.state
    k = 0
    while k < rows:
        state[k] = HOLDS
        if w.mu[k] > 0.0:
            if not before[k] > 0.0:
                state[k] = AT_LOW
            state[k + 1] = state[k + 2] = state[k]
            size = math.sqrt(before[k + 1] ** 2 + before[k + 2] ** 2)
            if before[k] > 0.0 and size >= (1.0 - 1e-9) * w.mu[k] * before[k]:
                a, b = -before[k + 1] / size, -before[k + 2] / size
                slide(w, k, a, b, max(0.0, a * w.slip[k + 1] + b * w.slip[k + 2]), before[k])
            k += 3
            continue
        if w.low[k] == 0.0:
            state[k] = HOLDS if before[k] > 0.0 else AT_LOW
        elif before[k] >= w.high[k]:
            state[k] = AT_HIGH
        elif before[k] <= w.low[k]:
            state[k] = AT_LOW
        k += 1


@inlined
def revise_contact(w: KernelWorld, k: int, tiny: float, least: float) -> None:
    """Change the state of a contact that violates Coulomb's law, or update the direction of its slip."""
    off, x, stiffness, state = w.y, w.x, w.g, w.state
    doing = state[k]
    if doing == AT_LOW:
        if off[k] < -tiny:
            strike(w, k, off[k], off[k + 1], off[k + 2], STIFFNESS / stiffness[k])
    elif x[k] < 0.0:
        state[k] = state[k + 1] = state[k + 2] = AT_LOW
    elif doing == HOLDS:
        size = math.sqrt(x[k + 1] ** 2 + x[k + 2] ** 2)
        if size > w.mu[k] * x[k] * (1.0 + 1e-9) + least:
            # The expected slip is the velocity that the excess of the impulse would have prevented.
            left = (size - w.mu[k] * x[k]) * STIFFNESS / max(stiffness[k + 1], stiffness[k + 2])
            slide(w, k, -x[k + 1] / size, -x[k + 2] / size, left, x[k])
    else:
        a, b = w.near_x[k + 1], w.near_x[k + 2]
        forward = a * off[k + 1] + b * off[k + 2]
        if forward < -tiny:
            state[k] = state[k + 1] = state[k + 2] = HOLDS
        else:
            slide(w, k, a, b, forward, x[k])


@compiled
def revise(w: KernelWorld, rows: int, tiny: float, least: float) -> bool:
    """Change the states that the velocities y of the rows contradict; return whether any state changed."""
    off = w.y
    changed = False
    k = 0
    while k < rows:
        doing = w.state[k]
        if w.mu[k] > 0.0:
            revise_contact(w, k, tiny, least)
            changed = changed or w.state[k] != doing
            k += 3
            continue
        if doing == HOLDS:
            if w.x[k] < w.low[k]:
                w.state[k] = AT_LOW
            elif w.x[k] > w.high[k]:
                w.state[k] = AT_HIGH
        else:
            if (doing == AT_LOW and off[k] < -tiny) or (doing == AT_HIGH and off[k] > tiny):
                w.state[k] = HOLDS
        changed = changed or w.state[k] != doing
        k += 1
    return changed


@compiled
def start_over(w: KernelWorld, rows: int, n: int) -> None:
    """Begin with the velocities that are without impulses, also of the rows, and with the impulses of the last step."""
    speed, off = w.block_v, w.y
    k = 0
    while k < rows:
        doing = w.state[k]
        if w.mu[k] > 0.0:
            w.x[k] = 0.0 if doing == AT_LOW else w.before[k]
            w.x[k + 1] = w.before[k + 1] if doing == HOLDS else 0.0
            w.x[k + 2] = w.before[k + 2] if doing == HOLDS else 0.0
            k += 3
            continue
        w.x[k] = w.before[k] if doing == HOLDS else (w.low[k] if doing == AT_LOW else w.high[k])
        k += 1
    for k in range(rows):
        off[k] = w.slip[k]
    for d in range(n):
        speed[d] = 0.0
