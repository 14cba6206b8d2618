"""Small matrices, written row by row without gaps: products of rows, and linear systems solved in place."""

from __future__ import annotations

from typing import Any

from urdfkit.sim.engine.compilation import inlined


@inlined
def factor_and_solve(n: int, B: Any, x: Any) -> bool:
    """Solve B·x = x in place, B symmetric and positive, its upper triangle given; return whether it was (LDLᵀ).

    What a column changes is subtracted from all that follow at once: nothing waits for a sum, and no root is taken.
    """
    for k in range(n):
        pivot = B[k * n + k]
        if not pivot > 0.0:
            return False
        inverse = 1.0 / pivot
        B[k * n + k] = inverse
        for i in range(k + 1, n):
            factor = B[k * n + i] * inverse
            x[i] -= factor * x[k]
            for j in range(i, n):
                B[i * n + j] -= factor * B[k * n + j]
    for k in range(n - 1, -1, -1):
        xk = x[k] * B[k * n + k]
        x[k] = xk
        for i in range(k):
            x[i] -= B[i * n + k] * xk
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


@inlined
def gram_row(rows: int, k: int, n: int, width: int, Y: Any, A: Any) -> None:
    """Write the products of the first n entries of row k with those of the rows up to it into A and its mirror."""
    at = k * width
    j = 0
    while j <= k:
        to = j * width
        if j + 3 <= k:
            # Four at a time, so that no sum has to wait for the one before.
            p = q = r = s = 0.0
            for d in range(n):
                y = Y[at + d]
                p += y * Y[to + d]
                q += y * Y[to + width + d]
                r += y * Y[to + 2 * width + d]
                s += y * Y[to + 3 * width + d]
            to = k * rows + j
            A[to], A[to + 1], A[to + 2], A[to + 3] = p, q, r, s
            to = j * rows + k
            A[to], A[to + rows], A[to + 2 * rows], A[to + 3 * rows] = p, q, r, s
            j += 4
        else:
            p = 0.0
            for d in range(n):
                p += Y[at + d] * Y[to + d]
            A[k * rows + j] = p
            A[j * rows + k] = p
            j += 1
