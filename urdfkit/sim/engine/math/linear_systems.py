"""Small linear systems, solved in place; matrices are written row by row."""

from typing import Any

from urdfkit.sim.engine.compilation import inlined
from urdfkit.sim.engine.math.simd import LANES, load16, padded, store


@inlined
def factor_and_solve(n: int, B: Any, x: Any) -> bool:
    """Solve a symmetric and positive system; return whether it was (LDLᵀ).

    B has ``padded(n + 1)`` entries a row: those of the upper triangle, and at n the right-hand side; it is spent. What
    a column changes is subtracted from all that follow at once: nothing waits for a sum, and no root is taken.
    """
    width = padded(n + 1)
    for k in range(n):
        pivot = B[k * width + k]
        if not pivot > 0.0:
            return False
        inverse = 1.0 / pivot
        for first in range(k & -LANES, width, LANES):
            row = load16(B, k * width + first)
            at, i = (k + 1) * width + first, k + 1
            last = min(n, first + LANES) * width
            while at < last:
                store(B, at, load16(B, at) - (B[k * width + i] * inverse) * row)
                at += width
                i += 1
        B[k * width + k] = inverse
    for k in range(n - 1, -1, -1):
        total = B[k * width + n]
        for j in range(n - 1, k, -1):
            total -= B[k * width + j] * x[j]
        x[k] = total * B[k * width + k]
    return True


@inlined
def eliminate_and_solve(n: int, B: Any, x: Any) -> bool:
    """Solve B·x = x; return whether B was regular (Gauss with partial pivoting).

    B has ``padded(n + 1)`` entries a row and is spent; x is eliminated with it, at n.
    """
    width = padded(n + 1)
    for i in range(n):
        B[i * width + n] = x[i]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(B[i * width + k]) > abs(B[pivot * width + k]):
                pivot = i
        if not abs(B[pivot * width + k]) > 0.0:
            return False
        if pivot != k:
            for first in range(k & -LANES, width, LANES):
                row = load16(B, k * width + first)
                store(B, k * width + first, load16(B, pivot * width + first))
                store(B, pivot * width + first, row)
        inverse = 1.0 / B[k * width + k]
        for i in range(k + 1, n):
            factor = B[i * width + k] * inverse
            if factor != 0.0:
                for first in range(k & -LANES, width, LANES):
                    at = i * width + first
                    store(B, at, load16(B, at) - factor * load16(B, k * width + first))
    for i in range(n - 1, -1, -1):
        total = B[i * width + n]
        for j in range(i + 1, n):
            total -= B[i * width + j] * x[j]
        x[i] = total / B[i * width + i]
    return True
