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
