"""Impulses of all rows: first directly, by guessing which rows hold; where that fails, by iteration.

The law: with w = A·x + g, a row has low ≤ x ≤ high, and w is zero unless x is at a bound, w ≥ 0 at the lower and w ≤ 0
at the upper one. A contact with friction has x ≥ 0 along its normal and tangential impulses inside the circle of radius
mu·x; where it slips they lie on the circle, against the slip (Coulomb). Impacts are perfectly inelastic.
"""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.compilation import compiled, inlined

HOLDS, AT_LOW, AT_HIGH, SLIDES = range(4)
"""What a row, or a contact by its normal row, is taken to do."""

SOFTNESS = 1e-9
"""Diagonal added to A, relative to it: it shares a load among redundant contacts."""
MEMORY = 0.99
"""How much of the last step's impulse the softness is measured from: a load that stays lets nothing creep."""
ATTEMPTS = 12
"""Guesses before the iteration takes over."""
FIRST = 1e-2
FACTOR = 0.1
FAIL = 100
SWEEPS = 400
"""Most sweeps of the iteration."""


@inlined
def factor_and_solve(n: int, B: Any, x: Any) -> bool:
    """Solve B·x = x in place, B symmetric and positive; return whether it was (Cholesky)."""
    for i in range(n):
        for j in range(i + 1):
            total = B[i * n + j]
            for k in range(j):
                total -= B[i * n + k] * B[j * n + k]
            if i == j:
                if not total > 0.0:
                    return False
                B[i * n + i] = 1.0 / math.sqrt(total)
            else:
                B[i * n + j] = total * B[j * n + j]
    for i in range(n):
        total = x[i]
        for k in range(i):
            total -= B[i * n + k] * x[k]
        x[i] = total * B[i * n + i]
    for i in range(n - 1, -1, -1):
        total = x[i]
        for k in range(i + 1, n):
            total -= B[k * n + i] * x[k]
        x[i] = total * B[i * n + i]
    return True


@compiled
def eliminate_and_solve(n: int, B: Any, x: Any) -> bool:
    """Solve B·x = x in place; return whether B was regular (Gauss with partial pivoting)."""
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(B[i * n + k]) > abs(B[pivot * n + k]):
                pivot = i
        if not abs(B[pivot * n + k]) > 0.0:
            return False
        if pivot != k:
            for j in range(k, n):
                B[k * n + j], B[pivot * n + j] = B[pivot * n + j], B[k * n + j]
            x[k], x[pivot] = x[pivot], x[k]
        inverse = 1.0 / B[k * n + k]
        for i in range(k + 1, n):
            factor = B[i * n + k] * inverse
            if factor != 0.0:
                for j in range(k + 1, n):
                    B[i * n + j] -= factor * B[k * n + j]
                x[i] -= factor * x[k]
    for i in range(n - 1, -1, -1):
        total = x[i]
        for j in range(i + 1, n):
            total -= B[i * n + j] * x[j]
        x[i] = total / B[i * n + i]
    return True


@inlined
def first_guess(
    rows: int, A: Any, g: Any, low: Any, high: Any, mu: Any, before: Any, state: Any, slip: Any, tiny: float
) -> None:
    """Guess from the last step's impulses what every row does."""
    k = 0
    while k < rows:
        if mu[k] > 0.0:
            normal = before[k]
            state[k] = HOLDS if normal > 0.0 or g[k] < -tiny else AT_LOW
            size = math.sqrt(before[k + 1] * before[k + 1] + before[k + 2] * before[k + 2])
            if size > 0.0 and size >= (1.0 - 1e-9) * mu[k] * normal:
                state[k] = SLIDES
                slip[k + 1], slip[k + 2] = -before[k + 1] / size, -before[k + 2] / size
                first = result(rows, A, g, before, k + 1)
                second = result(rows, A, g, before, k + 2)
                slip[k] = stiffening(first * slip[k + 1] + second * slip[k + 2], size, A[k * rows + k])
            elif normal == 0.0 and state[k] == HOLDS:
                strike(rows, A, g[k], g[k + 1], g[k + 2], mu, state, slip, k)
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
def stiffening(speed: float, size: float, most: float) -> float:
    """Return how much slip across its direction [m/s] an impulse of a sliding contact there [N·s] brings about.

    The impulse can only turn; the slip then turns too, and with a slip of `speed` under an impulse of a given `size`
    that takes speed/size.
    """
    return min(max(0.0, speed) / size, 1e9 * most) if size > 0.0 else 1e9 * most


@inlined
def strike(
    rows: int, A: Any, normal: float, first: float, second: float, mu: Any, state: Any, slip: Any, k: int
) -> None:
    """Guess, from the velocities with which it closes, whether a contact that was open will slide."""
    speed = math.sqrt(first * first + second * second)
    stopped = min(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
    force = -mu[k] * normal / A[k * rows + k]
    if speed > force * stopped:
        state[k] = SLIDES
        slip[k + 1], slip[k + 2] = first / speed, second / speed
        slip[k] = stiffening(speed - force * stopped, force, A[k * rows + k])


@inlined
def try_guess(
    rows: int,
    A: Any,
    g: Any,
    low: Any,
    high: Any,
    mu: Any,
    rest: Any,
    softness: float,
    state: Any,
    slip: Any,
    B: Any,
    y: Any,
    index: Any,
    x: Any,
) -> int:
    """Find the impulses at which all rows do what `state` says.

    Returns:
        How many unknowns that took, negative where contacts slide; 0 if there are no such impulses.
    """
    n = 0
    sliding = False
    k = 0
    while k < rows:
        x[k] = 0.0
        if state[k] == HOLDS:
            index[n] = k
            n += 1
        elif mu[k] > 0.0:
            x[k + 1] = x[k + 2] = 0.0
            if state[k] == SLIDES:
                sliding = True
                index[n], index[n + 1] = k, k + 1
                n += 2
            k += 3
            continue
        elif state[k] == AT_LOW:
            x[k] = low[k]
        else:
            x[k] = high[k]
        k += 1
    if sliding:
        return -n if try_sliding(rows, n, A, g, mu, rest, softness, state, slip, B, y, index, x) else 0
    for a in range(n):
        i = index[a]
        total = -g[i] + softness * A[i * rows + i] * rest[i]
        for j in range(rows):
            if x[j] != 0.0:
                total -= A[i * rows + j] * x[j]
        y[a] = total
        for b in range(a + 1):
            B[a * n + b] = A[i * rows + index[b]]
        B[a * n + a] += softness * A[i * rows + i]
    if not factor_and_solve(n, B, y):
        return 0
    for a in range(n):
        x[index[a]] = y[a]
    return n + 1


@compiled
def try_sliding(
    rows: int, n: int, A: Any, g: Any, mu: Any, rest: Any, softness: float, state: Any, slip: Any, B: Any, y: Any, index: Any, x: Any
) -> bool:
    """Find the impulses where contacts slide: one step of Newton's method for their directions.

    The unknowns of a sliding contact are its normal impulse, with which friction grows, and one across the friction
    that there was, which turns it.
    """
    row = rows * rows - rows
    for a in range(n):
        i = index[a]
        turns = mu[i] == 0.0 and state[i] == SLIDES
        total = 0.0
        if turns:
            # Across the slip, so that it has the slip's sense of turning.
            first, second = slip[i + 1], -slip[i]
            for j in range(rows):
                B[row + j] = first * A[i * rows + j] + second * A[(i + 1) * rows + j]
            total = -first * g[i] - second * g[i + 1]
        else:
            for j in range(rows):
                B[row + j] = A[i * rows + j]
            total = -g[i] + softness * A[i * rows + i] * rest[i]
        for j in range(rows):
            total -= B[row + j] * x[j]
        y[a] = total
        b = 0
        while b < n:
            j = index[b]
            if state[j] == SLIDES and mu[j] > 0.0:
                first, second = slip[j + 1], slip[j + 2]
                B[a * n + b] = B[row + j] - mu[j] * (B[row + j + 1] * first + B[row + j + 2] * second)
                B[a * n + b + 1] = B[row + j + 1] * second - B[row + j + 2] * first
                b += 2
            else:
                B[a * n + b] = B[row + j]
                b += 1
        B[a * n + a] += softness * A[i * rows + i] + (slip[i - 1] if turns else 0.0)
    if not eliminate_and_solve(n, B, y):
        return False
    for a in range(n):
        i = index[a]
        x[i] = y[a]
    return True


@inlined
def result(rows: int, A: Any, g: Any, x: Any, k: int) -> float:
    """Return w of row k."""
    total: float = g[k]
    for j in range(rows):
        total += A[k * rows + j] * x[j]
    return total


@inlined
def turn_slips(rows: int, A: Any, mu: Any, state: Any, slip: Any, x: Any, tiny: float) -> bool:
    """Turn the directions of slip to where a step of Newton's method points; return whether they were there.

    Afterwards x has the impulses of friction along the new directions.
    """
    there = True
    for k in range(rows):
        if state[k] == SLIDES and mu[k] > 0.0 and x[k] >= 0.0:
            most, across = mu[k] * x[k], x[k + 1]
            first, second = slip[k + 1], slip[k + 2]
            size = math.sqrt(most * most + across * across)
            if size > 0.0:
                a, b = (most * first - across * second) / size, (most * second + across * first) / size
                slip[k + 1], slip[k + 2] = a, b
            else:
                a, b = first, second
            x[k + 1], x[k + 2] = -most * a, -most * b
            # By how much the velocities are off for having gone straight where impulses turn.
            if (size - most) * A[k * rows + k] > tiny:
                there = False
    return there


@inlined
def revise_guess(
    rows: int, A: Any, g: Any, low: Any, high: Any, mu: Any, state: Any, slip: Any, x: Any, tiny: float
) -> bool:
    """Change what the law forbids in the guess; return whether nothing had to change."""
    right = True
    k = 0
    while k < rows:
        doing = state[k]
        if mu[k] > 0.0:
            if doing == AT_LOW:
                normal = result(rows, A, g, x, k)
                if normal < -tiny:
                    state[k] = HOLDS
                    first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                    strike(rows, A, normal, first, second, mu, state, slip, k)
            elif x[k] < 0.0:
                state[k] = AT_LOW
            elif doing == HOLDS:
                size = math.sqrt(x[k + 1] * x[k + 1] + x[k + 2] * x[k + 2])
                if size > mu[k] * x[k] * (1.0 + 1e-9):
                    state[k] = SLIDES
                    slip[k], slip[k + 1], slip[k + 2] = 0.0, -x[k + 1] / size, -x[k + 2] / size
            else:
                first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                speed = first * slip[k + 1] + second * slip[k + 2]
                across = second * slip[k + 1] - first * slip[k + 2]
                if speed < -tiny:
                    state[k] = HOLDS
                else:
                    if abs(across) > 1e-9 * speed + tiny:
                        right = False
                    slip[k] = stiffening(speed, mu[k] * x[k], A[k * rows + k])
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


@compiled
def sweep(rows: int, A: Any, g: Any, low: Any, high: Any, mu: Any, x: Any, sweeps: int) -> None:
    """Improve x by projected Gauss-Seidel sweeps with circular friction cones."""
    for _ in range(sweeps):
        k = 0
        while k < rows:
            x[k] = min(high[k], max(low[k], x[k] - result(rows, A, g, x, k) / A[k * rows + k]))
            if mu[k] > 0.0:
                stiffness = max(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
                a = x[k + 1] - result(rows, A, g, x, k + 1) / stiffness
                b = x[k + 2] - result(rows, A, g, x, k + 2) / stiffness
                size, most = math.sqrt(a * a + b * b), mu[k] * x[k]
                if size > most:
                    a, b = a * most / size, b * most / size
                x[k + 1], x[k + 2] = a, b
                k += 3
            else:
                k += 1


@inlined
def guess_from(rows: int, A: Any, g: Any, low: Any, high: Any, mu: Any, state: Any, slip: Any, x: Any) -> None:
    """Guess what every row does from impulses that are about right."""
    k = 0
    while k < rows:
        state[k] = HOLDS
        if mu[k] > 0.0:
            if x[k] <= 0.0:
                state[k] = AT_LOW
            else:
                first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                stiffness = max(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
                a, b = first - stiffness * x[k + 1], second - stiffness * x[k + 2]
                size, most = math.sqrt(a * a + b * b), mu[k] * x[k]
                if size > most * stiffness:
                    state[k] = SLIDES
                    slip[k + 1], slip[k + 2] = a / size, b / size
                    slip[k] = stiffening((first * a + second * b) / size, most, A[k * rows + k])
            state[k + 1] = state[k + 2] = state[k]
            k += 3
            continue
        if x[k] <= low[k]:
            state[k] = AT_LOW
        elif x[k] >= high[k]:
            state[k] = AT_HIGH
        k += 1


@inlined
def soften(rows: int, A: Any, mu: Any) -> None:
    """Let tangents along which nothing can move the bodies, as at a wheel of a bolted robot, yield a little.

    Their velocity is zero whatever the impulse; the softness keeps A regular and the impulse at zero.
    """
    for k in range(rows):
        if mu[k] > 0.0:
            for j in range(k + 1, k + 3):
                if A[j * rows + j] < 1e-15 * A[k * rows + k]:
                    A[j * rows + j] = 1e-9 * A[k * rows + k]


@inlined
def solve(
    rows: int,
    A: Any,
    g: Any,
    low: Any,
    high: Any,
    mu: Any,
    before: Any,
    state: Any,
    slip: Any,
    B: Any,
    y: Any,
    index: Any,
    swept: Any,
    x: Any,
) -> int:
    """Find the impulses x of all rows; return the number of guesses, or minus one where the iteration was needed."""
    largest = 0.0
    for k in range(rows):
        largest = max(largest, abs(g[k]))
    tiny = 1e-11 * largest + 1e-14
    soften(rows, A, mu)
    first_guess(rows, A, g, low, high, mu, before, state, slip, tiny)
    for k in range(rows):
        before[k] *= MEMORY
    tried = attempts(rows, A, g, low, high, mu, before, SOFTNESS, state, slip, B, y, index, x, tiny)
    if tried < ATTEMPTS:
        return tried + 1
    for k in range(rows):
        swept[k] = before[k]
    sweeps = 0
    while sweeps <= SWEEPS:
        softness = FIRST
        fails = 0
        guess_from(rows, A, g, low, high, mu, state, slip, swept)
        while fails < 3:
            now = attempts(rows, A, g, low, high, mu, swept, softness, state, slip, B, y, index, x, tiny)
            tried += now
            if now == ATTEMPTS:
                softness = min(1.0,FAIL*softness)
                fails += 1
                guess_from(rows, A, g, low, high, mu, state, slip, swept)
                continue
            off = 0.0
            for k in range(rows):
                off = max(off, softness*A[k*rows+k]*abs(swept[k]-x[k]))
                swept[k] = x[k]
            if softness == SOFTNESS or off < tiny:
                return tried if sweeps == 0 else -tried
            softness = max(FACTOR * softness, SOFTNESS)
        sweeps = max(10, 3 * sweeps)
        sweep(rows, A, g, low, high, mu, swept, sweeps)
    for k in range(rows):
        x[k] = swept[k]
    return 0


@compiled
def attempts(rows: int, A: Any, g: Any, low: Any, high: Any, mu: Any, rest: Any, softness: float, state: Any, slip: Any, B: Any, y: Any, index: Any, x: Any, tiny: float) -> int:
    """Guess."""
    for tried in range(ATTEMPTS):
        n = try_guess(rows, A, g, low, high, mu, rest, softness, state, slip, B, y, index, x)
        if n == 0:
            break
        there = n > 0 or turn_slips(rows, A, mu, state, slip, x, tiny)
        if revise_guess(rows, A, g, low, high, mu, state, slip, x, tiny) and there:
            return tried
    return ATTEMPTS
