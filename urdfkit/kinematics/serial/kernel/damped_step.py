"""The step of Levenberg and Marquardt in six dimensions: Δq = Jᵀ·(J·Jᵀ + λ·1)⁻¹·e."""

import math

from urdfkit.kinematics.serial.kernel.compilation import Floats, inlined, stack


@inlined
def gram_matrix(jacobian: Floats, size: int, L: Floats) -> None:
    """Compute the lower triangle of J·Jᵀ; six numbers per variable in `jacobian`, 36 by rows in `L`."""
    for k in range(36):
        L[k] = 0.0
    for j in range(size):
        for r in range(6):
            for c in range(r + 1):
                L[6 * r + c] += jacobian[6 * j + r] * jacobian[6 * j + c]


@inlined
def cholesky(L: Floats, size: int) -> None:
    """Factorise a matrix whose lower triangle is in `L`, by rows of six; the diagonal of the factor is inverted."""
    for r in range(size):
        for c in range(r):
            total = L[6 * r + c]
            for k in range(c):
                total -= L[6 * r + k] * L[6 * c + k]
            L[6 * r + c] = total * L[7 * c]
        total = L[7 * r]
        for k in range(r):
            total -= L[6 * r + k] * L[6 * r + k]
        L[7 * r] = 1.0 / math.sqrt(max(total, 1e-300))


@inlined
def volume(jacobian: Floats, size: int, rows: int) -> float:
    """Return the manipulability √det(J·Jᵀ) of the first rows; of Jᵀ·J where there are fewer variables than rows."""
    L = stack(36)
    if size >= rows:
        gram_matrix(jacobian, size, L)
    else:
        for r in range(size):
            for c in range(r + 1):
                L[6 * r + c] = 0.0
                for k in range(rows):
                    L[6 * r + c] += jacobian[6 * r + k] * jacobian[6 * c + k]
    least = min(size, rows)
    cholesky(L, least)
    product = 1.0
    for r in range(least):
        product /= L[7 * r]
    return product


@inlined
def damped_step(jacobian: Floats, size: int, error: Floats, damping: float, step: Floats) -> None:
    """Compute a step that reduces the error.

    Args:
        jacobian: six numbers per variable, weighted as the error is; zero for a variable that is held.
        size: number of variables.
        error: six weighted numbers.
        damping: λ, positive.
        step: written: one number per variable.
    """
    L = stack(36)
    y = stack(6)
    gram_matrix(jacobian, size, L)
    for r in range(6):
        L[7 * r] += damping
    cholesky(L, 6)
    for r in range(6):
        total = error[r]
        for k in range(r):
            total -= L[6 * r + k] * y[k]
        y[r] = total * L[7 * r]
    for i in range(6):
        r = 5 - i
        total = y[r]
        for k in range(r + 1, 6):
            total -= L[6 * k + r] * y[k]
        y[r] = total * L[7 * r]
    for j in range(size):
        total = 0.0
        for r in range(6):
            total += jacobian[6 * j + r] * y[r]
        step[j] = total
