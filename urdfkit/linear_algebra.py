"""Products, norms and inverses of small matrices, and rotations of quaternions, to the same bytes on every processor.

numpy's ``@``, ``dot``, ``linalg.norm`` of one vector, ``linalg.inv`` and ``linalg.eigh`` call OpenBLAS, which sums in
another order, or with fused multiply-add, depending on the processor. ``einsum`` does not.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

SUBSCRIPTS = {(1, 1): "i,i->", (1, 2): "i,ij->j", (2, 1): "ij,j->i", (2, 2): "ij,jk->ik"}


def matmul(a: ArrayLike, b: ArrayLike) -> Any:
    """Return ``a @ b``; a float where both are vectors."""
    a, b = np.asarray(a), np.asarray(b)
    found = np.einsum(SUBSCRIPTS.get((a.ndim, b.ndim), "...i,i->..." if b.ndim == 1 else "...ij,...jk->...ik"), a, b)
    return found if found.ndim else float(found)


def vector_norm(vector: ArrayLike) -> float:
    """Return the length of a vector."""
    vector = np.asarray(vector, dtype=float)
    return math.sqrt(np.einsum("i,i->", vector, vector))


def inverse_placement(placement: Array) -> Array:
    """Return the inverse of a placement; shape (4, 4)."""
    inverse = np.eye(4)
    inverse[:3, :3] = placement[:3, :3].T
    inverse[:3, 3] = -matmul(placement[:3, :3].T, placement[:3, 3])
    return inverse


def rotations(quaternions: Array) -> Array:
    """Return rotation matrices of unit quaternions x y z w; shape (N, 3, 3)."""
    x, y, z, w = quaternions.T
    rows = (
        *(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)),
        *(2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)),
        *(2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)),
    )
    return np.stack(rows, axis=1).reshape(-1, 3, 3)


def symmetric_eigen(matrix: ArrayLike) -> tuple[Array, Array]:
    """Return the eigenvalues of a symmetric matrix, ascending, and its eigenvectors in columns.

    Cyclic Jacobi rotations (Golub and Van Loan, Matrix Computations, section 8.5): each makes an element zero.
    """
    a = np.array(matrix, dtype=float)
    size = len(a)
    axes = np.eye(size)
    limit = 1e-30 * np.einsum("ij,ij->", a, a)
    for _ in range(50):
        off = np.triu(a, 1)
        if np.einsum("ij,ij->", off, off) <= limit:
            break
        for p in range(size):
            for q in range(p + 1, size):
                if a[p, q] == 0.0:
                    continue
                ratio = (a[q, q] - a[p, p]) / (2.0 * a[p, q])
                tangent = math.copysign(1.0, ratio) / (abs(ratio) + math.sqrt(ratio * ratio + 1.0))
                cosine = 1.0 / math.sqrt(tangent * tangent + 1.0)
                sine = tangent * cosine
                a[:, p], a[:, q] = cosine * a[:, p] - sine * a[:, q], sine * a[:, p] + cosine * a[:, q]
                a[p, :], a[q, :] = cosine * a[p, :] - sine * a[q, :], sine * a[p, :] + cosine * a[q, :]
                axes[:, p], axes[:, q] = (
                    cosine * axes[:, p] - sine * axes[:, q],
                    sine * axes[:, p] + cosine * axes[:, q],
                )
    values = np.diag(a)
    order = np.argsort(values, kind="stable")
    return values[order], axes[:, order]
