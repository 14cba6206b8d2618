"""Impulses of an island's rows by minimising a convex function of the velocities; converges from any start.

Each contact gives way along its cone, softly first: the velocities minimise the energy of the change plus, for every
row or contact, P(z)²/2D with z = x - D·(w + s), where x are the impulses so far, w the velocity of the row, D its
stiffness and P the projection onto the impulses that the law allows. Newton's method with a line search does that; its
matrix has the same blocks as that of the rows that hold. The impulses are then P(z), and the next round uses them and a
larger D (the augmented Lagrangian).

A minimum alone would have what slides rise at mu times its slip, as cones and slips go together in a convex problem;
that much, s, is taken from the normal's velocity (De Saxcé's correction), from the slip of the round before.

Rows that contradict each other, as where a body is wedged where there is no room, are never met, and their impulses
would grow with each round. Then this step corrects no penetrations, so that all rows are met with nothing
moving.

Sources: A. Castro et al., arXiv:2110.10107 (contact as a convex problem of the velocities); V. Acary, F. Cadoux et al.,
ZAMM 91 (2011) 155-175 (Coulomb's law as a sequence of convex problems). G. De Saxcé and Z.-Q. Feng, Math. Comput.
Modelling 28 (1998) 225-245 (the correction).
"""

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined
from urdfkit.sim.engine.island_solver.block_assembly import assemble
from urdfkit.sim.engine.island_solver.block_matrix import eliminate, substitute
from urdfkit.sim.engine.island_solver.jacobian_products import (
    push_contact,
    push_row,
    row_speed,
    row_speeds,
    take_momentum,
)
from urdfkit.sim.engine.kernel_world import KernelWorld
from urdfkit.sim.engine.simulation_memory import WIDTH
from urdfkit.sim.engine.solver.row_states import AT_HIGH, AT_LOW, HOLDS, SLIDES

STEPS = 30
"""Most steps of Newton's method in a round of an island that is no heap."""
SEARCHES = 8
"""Most places along a step that the line search evaluates."""


@inlined
def onto_cone(mu: float, normal: float, first: float, second: float) -> Any:
    """Return the impulse in the cone of friction nearest to one."""
    size = math.sqrt(first * first + second * second)
    if size <= mu * normal:
        return normal, first, second
    amount = normal + mu * size
    if amount <= 0.0:
        return 0.0, 0.0, 0.0
    amount /= 1.0 + mu * mu
    c = mu * amount / size
    return amount, c * first, c * second


@inlined
def classify(w: KernelWorld, rows: int, rest: Any) -> float:
    """Find what rows do at the velocities of now, add what they exert to `rest`, and return the largest impulse.

    Their impulses are kept in ``velocity``.
    """
    speeds, stiffness, exerted = w.y, w.g, w.velocity
    largest = 0.0
    k = 0
    while k < rows:
        D = stiffness[k]
        z = w.x[k] - D * speeds[k]
        if w.mu[k] > 0.0:
            first, second = w.x[k + 1] - D * speeds[k + 1], w.x[k + 2] - D * speeds[k + 2]
            p, a, b = onto_cone(w.mu[k], z, first, second)
            size = math.sqrt(first * first + second * second)
            w.state[k] = HOLDS if size <= w.mu[k] * z else (AT_LOW if p <= 0.0 else SLIDES)
            w.state[k + 1] = w.state[k + 2] = w.state[k]
            if w.state[k] == SLIDES:
                w.near_x[k], w.near_x[k + 1], w.near_x[k + 2] = D * w.mu[k] * p / size, -first / size, -second / size
            exerted[k], exerted[k + 1], exerted[k + 2] = p, a, b
            if p > 0.0:
                push_contact(w, k, p, a, b, rest)
                largest = max(largest, p)
            k += 3
            continue
        w.state[k] = AT_LOW if z <= w.low[k] else (AT_HIGH if z >= w.high[k] else HOLDS)
        p = min(w.high[k], max(w.low[k], z))
        exerted[k] = p
        if p != 0.0:
            push_row(w, k, p, rest)
            largest = max(largest, abs(p))
        k += 1
    return largest


@compiled
def slope(w: KernelWorld, rows: int, share: float, ahead: int) -> float:
    """Return how much power rows have along a step, of which a share has been taken; its rows' speeds are in A."""
    speeds, stiffness, A = w.y, w.g, w.A
    power = 0.0
    k = 0
    while k < rows:
        D = stiffness[k]
        z = w.x[k] - D * (speeds[k] + share * A[ahead + k])
        if w.mu[k] > 0.0:
            first = w.x[k + 1] - D * (speeds[k + 1] + share * A[ahead + k + 1])
            second = w.x[k + 2] - D * (speeds[k + 2] + share * A[ahead + k + 2])
            p, a, b = onto_cone(w.mu[k], z, first, second)
            power += p * A[ahead + k] + a * A[ahead + k + 1] + b * A[ahead + k + 2]
            k += 3
            continue
        power += min(w.high[k], max(w.low[k], z)) * A[ahead + k]
        k += 1
    return float(power)


@compiled
def descend(w: KernelWorld, root: int, rows: int, n: int, balance: float, most: int) -> int:
    """Go to the minimum of a round, until but this part of the impulses is out of balance; return the steps taken.

    It takes no more than `most` steps. For each row, y is the velocity with the correction, and x the impulse at that
    velocity.
    """
    speeds, speed, rest, exerted, inertia = w.y, w.block_v, w.block_f, w.velocity, w.sum_v
    momentum = w.sum_s
    ahead = 2 * w.sizes[WIDTH]
    for d in range(n):
        momentum[d] = 0.0
    take_momentum(w, root, speed, momentum)
    for taken in range(most):
        for d in range(n):
            rest[d] = momentum[d]
        largest = classify(w, rows, rest)
        off = 0.0
        for d in range(n):
            off = max(off, abs(rest[d]))
        if off <= balance * largest:
            return taken
        assemble(w, root, rows, n, True)
        if not eliminate(w, n):
            return taken
        substitute(w, n, rest)
        # The function's slope along the step is a + b·share less the power of the rows.
        for d in range(n):
            inertia[d] = 0.0
        take_momentum(w, root, rest, inertia)
        a = b = 0.0
        for d in range(n):
            a -= inertia[d] * speed[d]
            b -= inertia[d] * rest[d]
        row_speeds(w, rows, rest, w.A, ahead)
        start = a
        for k in range(rows):
            start -= exerted[k] * w.A[ahead + k]
        if not start < 0.0:
            return taken
        share = 1.0
        here = a + b - slope(w, rows, 1.0, ahead)
        if here > 0.0:
            # Between a place before the minimum and one beyond it (regula falsi, Illinois).
            low, at_low, high, at_high = 0.0, start, 1.0, here
            for _ in range(SEARCHES):
                if abs(here) <= -0.05 * start:
                    break
                share = (low * at_high - high * at_low) / (at_high - at_low)
                here = a + b * share - slope(w, rows, share, ahead)
                if here > 0.0:
                    high, at_high = share, here
                    at_low *= 0.5
                else:
                    low, at_low = share, here
                    at_high *= 0.5
        for d in range(n):
            speed[d] += share * rest[d]
            momentum[d] += share * inertia[d]
        for k in range(rows):
            speeds[k] += share * w.A[ahead + k]
    return most


@compiled
def update_multipliers(w: KernelWorld, rows: int) -> float:
    """Set the multipliers to the impulses of this round; return the residual of velocities and friction."""
    x, speeds, stiffness, s = w.x, w.y, w.g, w.before
    off = 0.0
    k = 0
    while k < rows:
        D = stiffness[k]
        z = x[k] - D * speeds[k]
        if w.mu[k] > 0.0:
            p, a, b = onto_cone(w.mu[k], z, x[k + 1] - D * speeds[k + 1], x[k + 2] - D * speeds[k + 2])
            off = max(off, max(abs(p - x[k]), max(abs(a - x[k + 1]), abs(b - x[k + 2]))) / D)
            x[k], x[k + 1], x[k + 2] = p, a, b
            slip = w.mu[k] * math.sqrt(speeds[k + 1] * speeds[k + 1] + speeds[k + 2] * speeds[k + 2])
            off = max(off, abs(slip - s[k]))
            k += 3
            continue
        p = min(w.high[k], max(w.low[k], z))
        off = max(off, abs(p - x[k]) / D)
        x[k] = p
        k += 1
    return float(off)


@compiled
def prepare_round(w: KernelWorld, rows: int, hardness: float, corrected: bool) -> None:
    """Set one penalty stiffness per contact, and the row velocities, corrected for slip after the first round."""
    speeds, s, stiffness, speed = w.y, w.before, w.g, w.block_v
    row_speeds(w, rows, speed, speeds, 0)
    for k in range(rows):
        speeds[k] += w.slip[k]
        s[k] = 0.0
    k = 0
    while k < rows:
        if w.mu[k] > 0.0:
            least = w.row_stiffness[k]
            for j in range(k + 1, k + 3):
                # A tangent along which nothing can move has none.
                if w.row_stiffness[j] > 0.0:
                    least = min(least, w.row_stiffness[j])
            stiffness[k] = stiffness[k + 1] = stiffness[k + 2] = hardness * least
            if corrected:
                s[k] = w.mu[k] * math.sqrt(speeds[k + 1] * speeds[k + 1] + speeds[k + 2] * speeds[k + 2])
                speeds[k] += s[k]
            k += 3
        else:
            stiffness[k] = hardness * w.row_stiffness[k]
            k += 1


@compiled
def limit_corrections(w: KernelWorld, rows: int) -> None:
    """Limit the corrections of penetrations and joint errors by the current velocities."""
    bias, speed = w.row_bias, w.block_v
    for k in range(rows):
        if w.high[k] < math.inf or bias[k] == 0.0 or (bias[k] > 0.0 and w.low[k] > -math.inf):
            continue
        off = w.slip[k] + row_speed(w, k, speed)
        if bias[k] < 0.0 and off < 0.0:
            taken = min(-off, -bias[k])
        elif bias[k] > 0.0 and off > 0.0:
            taken = -min(off, bias[k])
        else:
            continue
        w.slip[k] += taken
        bias[k] += taken
