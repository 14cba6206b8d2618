"""Small linear systems: against numpy."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.interpreted_kernel import interpreted, views
from urdfkit.sim.engine.math.linear_systems import eliminate_and_solve
from urdfkit.sim.engine.math.simd import padded
from urdfkit.sim.engine.simulation_memory import LETTERS, allocate


def solved(matrix, right):
    """Return whether a matrix is regular, and the solution."""
    n = len(right)
    a = allocate([max(n, 1) ** (2 if letter == "q" else 1) for letter in LETTERS], width=1)
    w, width = views(a.floats, a.integers), padded(n + 1)
    # Entries outside the matrix are not used.
    a.floats[:] = np.nan
    for i in range(n):
        for j in range(n):
            w.B[i * width + j] = matrix[i, j]
        w.y[i] = right[i]
    regular = interpreted(eliminate_and_solve.python)(n, w.B, w.y)
    return regular, np.array([w.y[i] for i in range(n)])


@pytest.mark.parametrize("n", [1, 2, 15, 16, 17, 33])
def test_systems_with_pivots_out_of_order_are_solved(n):
    rng = np.random.default_rng(n)
    matrix, right = rng.normal(size=(n, n)), rng.normal(size=n)
    matrix[0, 0] = 0.0 if n > 1 else 2.0
    regular, x = solved(matrix, right)
    assert regular
    assert x == pytest.approx(np.linalg.solve(matrix, right), rel=1e-9, abs=1e-9)


def test_a_singular_matrix_is_noticed():
    matrix = np.arange(9.0).reshape(3, 3)
    matrix[2] = matrix[1]
    assert not solved(matrix, np.ones(3))[0]
