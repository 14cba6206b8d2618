"""What rows of an island do, found as the minimum of a convex function of the velocities: it gets there from anywhere.

Each contact gives way along its cone, softly first: the velocities minimise the energy of the change plus, for every
row or contact, P(z)²/2D with z = x - D·(w + s), where x are the impulses so far, w the velocity of the row, D its
stiffness and P the projection onto the impulses that the law allows. Newton's method with a line search does that; its
matrix has the same blocks as that of the rows that hold. Then the impulses are P(z), and it goes on with these and a
larger D (the augmented Lagrangian).

A minimum alone would have what slides rise at mu times its slip, as cones and slips go together in a convex problem;
that much, s, is taken from the normal's velocity (De Saxcé's correction), from the slip of the round before.

Rows that contradict each other, as where a body is wedged where there is no room, are never met, and their impulses
would grow with each round. Then what was to be taken back of penetrations in this step is left as it is: with nothing
moving, all rows are met.

Sources: A. Castro et al., arXiv:2110.10107 (contact as a convex problem of the velocities); V. Acary, F. Cadoux et al.,
ZAMM 91 (2011) 155-175 (Coulomb's law as a sequence of convex problems). G. De Saxcé and Z.-Q. Feng, Math. Comput.
Modelling 28 (1998) 225-245 (the correction).
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.arrays import WIDTH, At
from urdfkit.sim.engine.compilation import compiled, field, inlined
from urdfkit.sim.engine.island_solver.block_assembly import assemble
from urdfkit.sim.engine.island_solver.block_matrix import eliminate, substitute
from urdfkit.sim.engine.island_solver.block_products import push_contact, push_row, row_speed, row_speeds, take_momentum
from urdfkit.sim.engine.solver.row_states import AT_HIGH, AT_LOW, HOLDS, SLIDES

STEPS = 30
"""Most steps of Newton's method in a round."""
SEARCHES = 8
"""Most places along a step that are looked at."""


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
def classify(floats: Any, integers: Any, rows: int, rest: Any) -> float:
    """Find what rows do at the velocities of now, add what they exert to `rest`, and return the largest impulse.

    Their impulses are kept in ``velocity``.
    """
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    w = field(floats, integers, At.y)
    stiffness = field(floats, integers, At.g)
    exerted = field(floats, integers, At.velocity)
    near = field(floats, integers, At.near_x)
    state = field(integers, integers, At.state)
    largest = 0.0
    k = 0
    while k < rows:
        D = stiffness[k]
        z = x[k] - D * w[k]
        if mu[k] > 0.0:
            first, second = x[k + 1] - D * w[k + 1], x[k + 2] - D * w[k + 2]
            p, a, b = onto_cone(mu[k], z, first, second)
            size = math.sqrt(first * first + second * second)
            state[k] = HOLDS if size <= mu[k] * z else (AT_LOW if p <= 0.0 else SLIDES)
            state[k + 1] = state[k + 2] = state[k]
            if state[k] == SLIDES:
                near[k], near[k + 1], near[k + 2] = D * mu[k] * p / size, -first / size, -second / size
            exerted[k], exerted[k + 1], exerted[k + 2] = p, a, b
            if p > 0.0:
                push_contact(floats, integers, k, p, a, b, rest)
                largest = max(largest, p)
            k += 3
            continue
        state[k] = AT_LOW if z <= low[k] else (AT_HIGH if z >= high[k] else HOLDS)
        p = min(high[k], max(low[k], z))
        exerted[k] = p
        if p != 0.0:
            push_row(floats, integers, k, p, rest)
            largest = max(largest, abs(p))
        k += 1
    return largest


@compiled
def slope(floats: Any, integers: Any, rows: int, share: float, ahead: int) -> float:
    """Return how much power rows have along a step, of which a share has been taken; its rows' speeds are in A."""
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    w = field(floats, integers, At.y)
    stiffness = field(floats, integers, At.g)
    A = field(floats, integers, At.A)
    power = 0.0
    k = 0
    while k < rows:
        D = stiffness[k]
        z = x[k] - D * (w[k] + share * A[ahead + k])
        if mu[k] > 0.0:
            first = x[k + 1] - D * (w[k + 1] + share * A[ahead + k + 1])
            second = x[k + 2] - D * (w[k + 2] + share * A[ahead + k + 2])
            p, a, b = onto_cone(mu[k], z, first, second)
            power += p * A[ahead + k] + a * A[ahead + k + 1] + b * A[ahead + k + 2]
            k += 3
            continue
        power += min(high[k], max(low[k], z)) * A[ahead + k]
        k += 1
    return float(power)


@compiled
def descend(floats: Any, integers: Any, root: int, rows: int, n: int, balance: float) -> int:
    """Go to the minimum of a round, until but this part of the impulses is out of balance; return the steps taken.

    Of each row y is the velocity, with the correction; what it exerts there is the impulse.
    """
    w = field(floats, integers, At.y)
    A = field(floats, integers, At.A)
    speed = field(floats, integers, At.block_v)
    rest = field(floats, integers, At.block_f)
    exerted = field(floats, integers, At.velocity)
    inertia = field(floats, integers, At.sum_v)
    momentum = field(floats, integers, At.sum_s)
    ahead = 2 * integers[WIDTH]
    for d in range(n):
        momentum[d] = 0.0
    take_momentum(floats, integers, root, speed, momentum)
    for taken in range(STEPS):
        for d in range(n):
            rest[d] = momentum[d]
        largest = classify(floats, integers, rows, rest)
        off = 0.0
        for d in range(n):
            off = max(off, abs(rest[d]))
        if off <= balance * largest:
            return taken
        assemble(floats, integers, root, rows, n, True)
        if not eliminate(floats, integers, n):
            return taken
        substitute(floats, integers, n, rest)
        # The function's slope along the step is a + b·share less the power of the rows.
        for d in range(n):
            inertia[d] = 0.0
        take_momentum(floats, integers, root, rest, inertia)
        a = b = 0.0
        for d in range(n):
            a -= inertia[d] * speed[d]
            b -= inertia[d] * rest[d]
        row_speeds(floats, integers, rows, rest, A, ahead)
        start = a
        for k in range(rows):
            start -= exerted[k] * A[ahead + k]
        if not start < 0.0:
            return taken
        share = 1.0
        here = a + b - slope(floats, integers, rows, 1.0, ahead)
        if here > 0.0:
            # Between a place before the minimum and one beyond it (regula falsi, Illinois).
            low, at_low, high, at_high = 0.0, start, 1.0, here
            for _ in range(SEARCHES):
                if abs(here) <= -0.05 * start:
                    break
                share = (low * at_high - high * at_low) / (at_high - at_low)
                here = a + b * share - slope(floats, integers, rows, share, ahead)
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
            w[k] += share * A[ahead + k]
    return STEPS


@inlined
def take_over(floats: Any, integers: Any, rows: int) -> float:
    """Make the impulses of a round those so far; return by how much velocities, or the correction, are off."""
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    mu = field(floats, integers, At.mu)
    x = field(floats, integers, At.x)
    w = field(floats, integers, At.y)
    stiffness = field(floats, integers, At.g)
    s = field(floats, integers, At.before)
    off = 0.0
    k = 0
    while k < rows:
        D = stiffness[k]
        z = x[k] - D * w[k]
        if mu[k] > 0.0:
            p, a, b = onto_cone(mu[k], z, x[k + 1] - D * w[k + 1], x[k + 2] - D * w[k + 2])
            off = max(off, max(abs(p - x[k]), max(abs(a - x[k + 1]), abs(b - x[k + 2]))) / D)
            x[k], x[k + 1], x[k + 2] = p, a, b
            slip = mu[k] * math.sqrt(w[k + 1] * w[k + 1] + w[k + 2] * w[k + 2])
            off = max(off, abs(slip - s[k]))
            k += 3
            continue
        p = min(high[k], max(low[k], z))
        off = max(off, abs(p - x[k]) / D)
        x[k] = p
        k += 1
    return off


@inlined
def set_out(floats: Any, integers: Any, rows: int, hardness: float, corrected: bool) -> None:
    """Give rows one stiffness for each contact, and their velocities at the velocities of now, corrected or not."""
    mu = field(floats, integers, At.mu)
    g = field(floats, integers, At.slip)
    w = field(floats, integers, At.y)
    s = field(floats, integers, At.before)
    felt = field(floats, integers, At.felt)
    stiffness = field(floats, integers, At.g)
    speed = field(floats, integers, At.block_v)
    row_speeds(floats, integers, rows, speed, w, 0)
    for k in range(rows):
        w[k] += g[k]
        s[k] = 0.0
    k = 0
    while k < rows:
        if mu[k] > 0.0:
            least = felt[k]
            for j in range(k + 1, k + 3):
                # A tangent along which nothing can move has none.
                if felt[j] > 0.0:
                    least = min(least, felt[j])
            stiffness[k] = stiffness[k + 1] = stiffness[k + 2] = hardness * least
            if corrected:
                s[k] = mu[k] * math.sqrt(w[k + 1] * w[k + 1] + w[k + 2] * w[k + 2])
                w[k] += s[k]
            k += 3
        else:
            stiffness[k] = hardness * felt[k]
            k += 1


@compiled
def leave_wedged(floats: Any, integers: Any, rows: int) -> None:
    """Take back of penetrations, and of what joints are off, only what the velocities of now allow."""
    low = field(floats, integers, At.low)
    high = field(floats, integers, At.high)
    bias = field(floats, integers, At.row_bias)
    g = field(floats, integers, At.slip)
    speed = field(floats, integers, At.block_v)
    for k in range(rows):
        if high[k] < math.inf:
            continue
        w = g[k] + row_speed(floats, integers, k, speed)
        if bias[k] < 0.0 and w < 0.0:
            taken = min(-w, -bias[k])
        elif low[k] == -math.inf and bias[k] > 0.0 and w > 0.0:
            taken = -min(w, bias[k])
        else:
            continue
        g[k] += taken
        bias[k] += taken
