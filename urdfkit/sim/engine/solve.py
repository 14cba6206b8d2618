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
ATTEMPTS = 16
"""Guesses before the iteration takes over."""
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
def first_guess(rows: int, g: Any, low: Any, high: Any, mu: Any, before: Any, state: Any, slip: Any) -> None:
    """Guess from the last step's impulses what every row does."""
    k = 0
    while k < rows:
        if mu[k] > 0.0:
            state[k] = HOLDS if before[k] > 0.0 or g[k] < 0.0 else AT_LOW
            state[k + 1] = state[k + 2] = state[k]
            size = math.sqrt(before[k + 1] * before[k + 1] + before[k + 2] * before[k + 2])
            if size > 0.0 and size >= (1.0 - 1e-9) * mu[k] * before[k]:
                state[k] = SLIDES
                slip[k + 1], slip[k + 2] = -before[k + 1] / size, -before[k + 2] / size
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
def try_guess(
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
    x: Any,
) -> bool:
    """Find the impulses at which all rows do what `state` says; return whether there are any."""
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
                index[n] = k
                n += 1
            k += 3
            continue
        elif state[k] == AT_LOW:
            x[k] = low[k]
        else:
            x[k] = high[k]
        k += 1
    for a in range(n):
        i = index[a]
        total = -g[i] + SOFTNESS * MEMORY * A[i * rows + i] * before[i]
        for j in range(rows):
            if x[j] != 0.0:
                total -= A[i * rows + j] * x[j]
        y[a] = total
        for b in range(n if sliding else a + 1):
            j = index[b]
            entry = A[i * rows + j]
            if state[j] == SLIDES:
                entry -= mu[j] * (A[i * rows + j + 1] * slip[j + 1] + A[i * rows + j + 2] * slip[j + 2])
            B[a * n + b] = entry
        B[a * n + a] += SOFTNESS * A[i * rows + i]
    if not (eliminate_and_solve(n, B, y) if sliding else factor_and_solve(n, B, y)):
        return False
    for a in range(n):
        i = index[a]
        x[i] = y[a]
        if state[i] == SLIDES:
            x[i + 1] = -mu[i] * slip[i + 1] * y[a]
            x[i + 2] = -mu[i] * slip[i + 2] * y[a]
    return True


@inlined
def result(rows: int, A: Any, g: Any, x: Any, k: int) -> float:
    """Return w of row k."""
    total: float = g[k]
    for j in range(rows):
        total += A[k * rows + j] * x[j]
    return total


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
                if result(rows, A, g, x, k) < -tiny:
                    state[k] = HOLDS
            elif x[k] < 0.0:
                state[k] = AT_LOW
            elif doing == HOLDS:
                size = math.sqrt(x[k + 1] * x[k + 1] + x[k + 2] * x[k + 2])
                if size > mu[k] * x[k] * (1.0 + 1e-9):
                    state[k] = SLIDES
                    slip[k + 1], slip[k + 2] = -x[k + 1] / size, -x[k + 2] / size
            else:
                first, second = result(rows, A, g, x, k + 1), result(rows, A, g, x, k + 2)
                speed = math.sqrt(first * first + second * second)
                if first * slip[k + 1] + second * slip[k + 2] < -tiny:
                    state[k] = HOLDS
                elif speed > tiny:
                    first, second = first / speed, second / speed
                    if abs(first - slip[k + 1]) + abs(second - slip[k + 2]) > 1e-9:
                        right = False
                        slip[k + 1], slip[k + 2] = first, second
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
def iterate(rows: int, A: Any, g: Any, low: Any, high: Any, mu: Any, x: Any, tiny: float) -> None:
    """Improve x by projected Gauss-Seidel sweeps with circular friction cones until nothing moves."""
    for _ in range(SWEEPS):
        moved = 0.0
        k = 0
        while k < rows:
            stiffness = A[k * rows + k]
            old = x[k]
            x[k] = min(high[k], max(low[k], old - result(rows, A, g, x, k) / stiffness))
            moved = max(moved, abs(x[k] - old) * stiffness)
            if mu[k] > 0.0:
                stiffness = max(A[(k + 1) * rows + k + 1], A[(k + 2) * rows + k + 2])
                first, second = x[k + 1], x[k + 2]
                a = first - result(rows, A, g, x, k + 1) / stiffness
                b = second - result(rows, A, g, x, k + 2) / stiffness
                size, most = math.sqrt(a * a + b * b), mu[k] * x[k]
                if size > most:
                    a, b = a * most / size, b * most / size
                x[k + 1], x[k + 2] = a, b
                moved = max(moved, (abs(a - first) + abs(b - second)) * stiffness)
                k += 3
            else:
                k += 1
        if moved < tiny:
            break


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
    x: Any,
) -> int:
    """Find the impulses x of all rows; return the number of guesses, or minus one where the iteration was needed."""
    largest = 0.0
    for k in range(rows):
        largest = max(largest, abs(g[k]))
    tiny = 1e-11 * largest + 1e-14
    soften(rows, A, mu)
    first_guess(rows, g, low, high, mu, before, state, slip)
    for attempt in range(ATTEMPTS):
        if not try_guess(rows, A, g, low, high, mu, before, state, slip, B, y, index, x):
            break
        if revise_guess(rows, A, g, low, high, mu, state, slip, x, tiny):
            return attempt + 1
    for k in range(rows):
        x[k] = before[k]
    iterate(rows, A, g, low, high, mu, x, tiny)
    return -1
