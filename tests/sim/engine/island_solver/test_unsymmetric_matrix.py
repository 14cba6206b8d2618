"""The matrix of an island where contacts slide: against the same matrix written out."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.engine.island_solver.test_velocity_blocks import ISLANDS, problem
from urdfkit.sim.engine.island_solver.block_matrix import arrange
from urdfkit.sim.engine.island_solver.unsymmetric_matrix import (
    assemble_unsymmetric,
    factor_unsymmetric,
    substitute_unsymmetric,
)
from urdfkit.sim.engine.kernel_cache import load_compiled, world_digest
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.solver.row_states import AT_LOW, HOLDS, SLIDES

pytestmark = pytest.mark.slow  # in a fresh checkout: the functions are compiled first


def solved(floats, integers, root, rows):
    w = world(floats, integers)
    n = arrange(w, root, rows)
    assemble_unsymmetric(w, root, rows, n, w.u_free)
    if not factor_unsymmetric(w, n):
        return 0
    substitute_unsymmetric(w, n, w.block_f)
    return n


@pytest.fixture(scope="module")
def solve():
    return load_compiled(solved, ("floats", "integers", "count", "count"), digest=world_digest())


def local_matrix(a, k):
    """Return W of a contact: minus the change of its impulses with the velocities of its rows."""
    D, mu, state = a["g"][k], a["mu"][k], a["state"][k]
    if state == AT_LOW:
        return np.zeros((3, 3))
    if state == HOLDS:
        return D * np.eye(3)
    along = a["near_x"][k + 1 : k + 3]
    across = np.array([-along[1], along[0]])
    W = np.zeros((3, 3))
    W[0, 0] = D
    W[1:, 1:] = a["near_x"][k] * np.outer(across, across)
    W[1:, 0] = -mu * D * along
    return W


@pytest.mark.parametrize("name", ISLANDS)
def test_solutions_are_those_of_the_matrix_written_out(solve, name):
    rng = np.random.default_rng(len(name))
    a, J, x, _ = problem(rng, *ISLANDS[name], points=4, mu=0.8)
    rows, dofs = len(x), len(a["u"])
    a["g"][:] = np.repeat(rng.uniform(1.0, 50.0, rows // 3), 3)
    a["state"][:] = np.repeat(rng.choice([HOLDS, AT_LOW, SLIDES], rows // 3), 3)
    for k in range(0, rows, 3):
        angle = rng.uniform(0.0, 2.0 * np.pi)
        a["near_x"][k : k + 3] = rng.uniform(0.0, 20.0), np.cos(angle), np.sin(angle)
    K = np.zeros((dofs, dofs))
    for start, beyond in zip(a["tree_dof"], a["tree_dof"][1:], strict=False):
        n, at = beyond - start, a["dof_row"][start] + start
        K[start:beyond, start:beyond] = a["M"][at : at + n * n].reshape(n, n)
    a["u_free"][:] = np.diag(K)
    a["slope_v"][:] = 1.0
    for k in range(0, rows, 3):
        K += J[k : k + 3].T @ local_matrix(a, k) @ J[k : k + 3]
    right = rng.normal(size=dofs)
    # The order of the blocks is found first, so the right-hand side is sorted afterwards.
    assert solve(a.floats, a.integers, 0, rows) == dofs
    order = np.concatenate([np.arange(a["tree_dof"][t], a["tree_dof"][t + 1]) for t in a["block_tree"]])
    a["block_f"][:] = right[order]
    assert solve(a.floats, a.integers, 0, rows) == dofs
    answer = np.empty(dofs)
    answer[order] = a["block_f"]
    assert answer == pytest.approx(np.linalg.solve(K, right), rel=1e-7, abs=1e-9)


def test_a_singular_matrix_is_noticed(solve):
    a, _, x, _ = problem(np.random.default_rng(3), *ISLANDS["stack"], points=1)
    a["M"][:] = a["u_free"][:] = 0.0
    a["state"][:], a["slope_v"][:] = AT_LOW, 1.0
    assert solve(a.floats, a.integers, 0, len(x)) == 0
