"""Distinct rows of an array."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

FACTORS = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x27D4EB2F165667C5, 0x85EBCA77C2B2AE63,
           0xFF51AFD7ED558CCD, 0xC4CEB9FE1A85EC53, 0xA0761D6478BD642F, 0xE7037ED1A0B428DB,
           0x8EBC6AF09C88C6E3)  # fmt: skip
"""Odd multipliers of a hash; one per column."""


def unique_rows(rows: NDArray[Any]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the first index of each distinct row of integers, and the index of each row among the distinct ones.

    Rows are compared by a hash of their entries, which is much faster to sort than the rows. If different rows have the
    same hash, the rows themselves are sorted.

    Args:
        rows: shape (n, k), k at most ten.
    """
    factors = np.array(FACTORS, dtype=np.uint64)[: rows.shape[1]]
    keys = (rows.astype(np.int64).view(np.uint64) * factors).sum(axis=1, dtype=np.uint64)
    _, first, where = np.unique(keys, return_index=True, return_inverse=True)
    if not np.array_equal(rows[first[where]], rows):
        _, first, where = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    return first, where.reshape(-1)
