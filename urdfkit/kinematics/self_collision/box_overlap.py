"""Which of many relative placements of two boxes overlap: the separating-axis test of oriented boxes, by numpy.

Source: Gottschalk, Lin and Manocha, OBBTree, 1996.
"""

import numpy as np
from numpy.typing import NDArray

from urdfkit.linear_algebra import Array

PARALLEL = 1e-9
"""Added to products of directions: edges that are nearly parallel have no axis of their own."""


def overlapping(rotation: Array, translation: Array, first: Array, second: Array) -> NDArray[np.intp]:
    """Return the indices of the placements in which two boxes overlap, in order.

    Args:
        rotation: from the axes of the second box to those of the first; shape (N, 3, 3).
        translation: of the centre of the second box in the axes of the first [m]; shape (N, 3).
        first: half sizes of the first box [m]; shape (3,).
        second: half sizes of the second box [m]; shape (3,).
    """
    size = np.abs(rotation) + PARALLEL
    open_ = np.all(np.abs(translation) <= first + size @ second, axis=1)
    left = np.flatnonzero(open_)
    rotation, translation, size = rotation[left], translation[left], size[left]
    along = np.abs(np.einsum("nij,ni->nj", rotation, translation))
    kept = np.all(along <= second + np.einsum("nij,i->nj", size, first), axis=1)
    left, rotation, translation, size = left[kept], rotation[kept], translation[kept], size[kept]
    kept = np.ones(len(left), bool)
    for i in range(3):
        a, b = (i + 1) % 3, (i + 2) % 3
        for j in range(3):
            c, d = (j + 1) % 3, (j + 2) % 3
            reach = first[a] * size[:, b, j] + first[b] * size[:, a, j]
            reach += second[c] * size[:, i, d] + second[d] * size[:, i, c]
            gap = np.abs(translation[:, b] * rotation[:, a, j] - translation[:, a] * rotation[:, b, j])
            kept &= gap <= reach
    return np.asarray(left[kept])
