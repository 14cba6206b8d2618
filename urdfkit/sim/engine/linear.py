"""Small linear systems, solved in place; matrices are written row by row without gaps."""

from __future__ import annotations

import math
from typing import Any

from urdfkit.sim.engine.compilation import inlined


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
