"""Products, norms and inverses of small matrices, to the same bytes on every processor.

numpy's ``@``, ``dot``, ``linalg.norm`` of one vector and ``linalg.inv`` call OpenBLAS, which sums in another order, or
with fused multiply-add, depending on the processor. ``einsum`` does not.
"""

from __future__ import annotations

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
