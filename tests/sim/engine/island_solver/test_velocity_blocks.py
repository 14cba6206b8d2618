"""Islands solved by blocks: against the equations themselves, and where contacts slide against the law."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.island_solver.augmented_lagrangian import HEAP, MORE_ROUNDS
from urdfkit.sim.engine.island_solver.block_matrix import MOST_TREES
from urdfkit.sim.engine.island_solver.velocity_blocks import hold
from urdfkit.sim.engine.kernel_cache import load_compiled, world_digest
from urdfkit.sim.engine.kernel_world import world
from urdfkit.sim.engine.simulation_memory import LETTERS, allocate
from urdfkit.sim.engine.solver.row_states import AT_LOW, HOLDS, SLIDES

pytestmark = pytest.mark.slow  # in a fresh checkout: the kernel is compiled first


def held(floats, integers, root, rows):
    return hold(world(floats, integers), root, rows)


@pytest.fixture(scope="module")
def solve():
    return load_compiled(held, ("floats", "integers", "count", "count"), digest=world_digest())


def problem(rng, sizes, touching, points=4, mu=5.0, *, rests=False):
    """Return arrays of trees of so many dofs, each pair of `touching` with some contacts, and the answer.

    Velocities and forces are random, unless all rests.
    """
    trees, dofs = len(sizes), sum(sizes)
    rows = 3 * points * len(touching)
    width = 2 * max(sizes)
    counts = dict.fromkeys(LETTERS, 1)
    counts |= {
        "d": dofs,
        "r": rows,
        "t": trees,
        "e": sum(n * n for n in sizes),
        "y": rows * width,
        "q": max(rows, dofs) ** 2,
    }
    a = allocate([counts[letter] for letter in LETTERS], width=width)
    first = np.concatenate([[0], np.cumsum(sizes)])
    a["tree_dof"][:] = first
    a["island_next"][:] = [*range(1, trees), -1]
    M = np.zeros((dofs, dofs))
    entry = 0
    for start, n in zip(first, sizes, strict=False):
        root = rng.normal(size=(n, n))
        own = root @ root.T + n * np.eye(n)
        M[start : start + n, start : start + n] = own
        # M = LᵀL, the diagonal of L squared.
        L = np.linalg.cholesky(own[::-1, ::-1])[::-1, ::-1].T
        a["inverse_diagonal"][start : start + n] = 1.0 / np.diag(L)
        a["dof_row"][start : start + n] = entry + np.arange(n) * n - start
        a["dof_parent"][start : start + n] = [-1, *range(start, start + n - 1)]
        stored = L.copy()
        np.fill_diagonal(stored, np.diag(L) ** 2)
        a["L"][entry : entry + n * n], a["M"][entry : entry + n * n] = stored.ravel(), own.ravel()
        entry += n * n
    J = np.zeros((rows, dofs))
    Y = a["Y"].reshape(rows, width)
    for k, (one, other) in enumerate(touching):
        for row in range(3 * points * k, 3 * points * (k + 1)):
            a["row_a"][row], a["row_b"][row] = one, other
            at = 0
            for tree in (one, other):
                if tree >= 0:
                    J[row, first[tree] : first[tree + 1]] = rng.normal(size=sizes[tree])
                    Y[row, at : at + sizes[tree]] = J[row, first[tree] : first[tree + 1]]
                    at += sizes[tree]
    # No more equations than there are unknowns: what is over repeats the others.
    normal = np.arange(0, rows, 3)
    a["low"][:], a["high"][:] = -np.inf, np.inf
    a["low"][normal], a["mu"][normal] = 0.0, mu
    x = 0.1 * rng.normal(size=rows)
    x[normal] = rng.uniform(1.0, 2.0, len(normal))
    a["v_start"][:], a["u"][:] = rng.normal(size=dofs), rng.normal(size=dofs)
    free, change = np.zeros(dofs), np.linalg.solve(M, J.T @ x)
    for start, n in zip(first, sizes, strict=False):
        part = slice(start, start + n)
        L = np.linalg.cholesky(M[part, part][::-1, ::-1])[::-1, ::-1].T
        if rests:
            a["v_start"][part], a["u"][part] = 0.0, -L @ change[part]
        free[part] = np.linalg.solve(L, a["u"][part])
    a["row_bias"][:] = -J @ (a["v_start"] + free + change)
    return a, J, x, free + change


ISLANDS = {
    "two boxes": ([6, 6], [(0, -1), (0, 1)]),
    "stack": ([6] * 5, [(0, -1), (0, 1), (1, 2), (2, 3), (3, 4)]),
    "table": ([6] * 7, [(0, -1), *((k, 0) for k in range(1, 7))]),
    "arch": ([6] * 6, [(0, -1), (5, -1), (1, 0), (2, 1), (3, 2), (4, 3), (5, 4), (2, 4)]),
    "robots": ([8, 6, 9, 6, 7], [(0, -1), (1, 0), (1, 2), (2, 3), (4, -1), (4, 3), (0, 4)]),
}


@pytest.mark.parametrize("name", ISLANDS)
@pytest.mark.parametrize("points", [1, 4])
def test_velocities_and_what_each_tree_feels_are_those_of_the_equations(solve, name, points):
    rng = np.random.default_rng(len(name) + points)
    a, J, x, change = problem(rng, *ISLANDS[name], points=points)
    a["before"][:] = x + 1e-3 * rng.normal(size=len(x))
    assert solve(a.floats, a.integers, 0, len(x)) == 1
    assert a["u"] == pytest.approx(change, abs=1e-9)
    assert a["x"] @ J == pytest.approx(x @ J, rel=1e-8, abs=1e-8)


def pile(rng, count):
    """Return bodies of six dofs that each lie on another or on the ground, some on two."""
    touching = [(0, -1), *((k, int(rng.integers(-1, k))) for k in range(1, count))]
    touching += [(k, int(rng.integers(0, k))) for k in range(2, count) if rng.random() < 0.25]
    return [6] * count, touching


@pytest.mark.parametrize("seed", range(8))
def test_random_piles(solve, seed):
    rng = np.random.default_rng(seed)
    a, J, x, change = problem(rng, *pile(rng, int(rng.integers(8, 25))), points=1)
    assert len(x) <= HEAP
    a["before"][:] = x
    assert solve(a.floats, a.integers, 0, len(x)) == 1
    assert a["u"] == pytest.approx(change, abs=1e-8)
    assert a["x"] @ J == pytest.approx(x @ J, rel=1e-7, abs=1e-7)


@pytest.mark.parametrize("count", [40, 70, MOST_TREES])
def test_a_heap_at_rest_stays_where_it_is(solve, count):
    rng = np.random.default_rng(count)
    a, J, x, change = problem(rng, *pile(rng, count), points=2, rests=True)
    assert len(x) > HEAP
    a["before"][:] = x
    assert solve(a.floats, a.integers, 0, len(x)) == 1
    assert a["u"] == pytest.approx(change, abs=1e-8)
    assert a["x"] @ J == pytest.approx(x @ J, rel=1e-7, abs=1e-7)


def test_what_cannot_carry_lets_go(solve):
    a, _, x, _ = problem(np.random.default_rng(5), *ISLANDS["stack"], points=1)
    # This one would have to pull.
    a["row_bias"][3] += 1e3
    a["before"][:] = x
    assert solve(a.floats, a.integers, 0, len(x)) > 1
    assert a["state"][3] == AT_LOW
    assert a["x"][3:6].tolist() == [0.0, 0.0, 0.0]
    assert (a["state"][[0, 6, 9, 12]] == HOLDS).all()


def violation(a, J, x):
    """Return by how much Coulomb's law is broken at contacts that are all closed or open [m/s or N·s]."""
    v = a["v_start"] + a["u"]
    w, worst = J @ v + a["row_bias"], 0.0
    for k in range(0, len(x), 3):
        mu, normal, force, slip = a["mu"][k], x[k], x[k + 1 : k + 3], w[k + 1 : k + 3]
        size, speed = np.linalg.norm(force), np.linalg.norm(slip)
        worst = max(worst, -normal, -w[k], min(normal, abs(w[k])), size - mu * normal)
        if size < mu * normal * (1.0 - 1e-7):
            worst = max(worst, speed)
        elif normal > 0.0:
            worst = max(worst, np.linalg.norm(slip + speed * force / size))
    return worst


@pytest.mark.parametrize("name", ["two boxes", "stack", "arch"])
@pytest.mark.parametrize("mu", [0.01, 0.05, 0.2])
def test_what_slides_obeys_coulomb(solve, name, mu):
    a, J, x, _ = problem(np.random.default_rng(len(name)), *ISLANDS[name], points=1, mu=mu)
    # Contacts that do not repeat each other: the answer is one of few, and exact.
    a["before"][:] = x
    a["before"][1::3] *= 0.05
    a["before"][2::3] *= 0.05
    assert solve(a.floats, a.integers, 0, len(x)) != 0
    assert (a["state"] == SLIDES).any() or mu > 0.1
    assert violation(a, J, np.array(a["x"])) < 1e-9


@pytest.mark.parametrize("seed", range(1, 6))
def test_bodies_that_all_strike_and_slide_obey_coulomb(solve, seed):
    # Nothing is known from the last step, and friction is as strong as the normal force.
    rng = np.random.default_rng(seed)
    a, J, x, _ = problem(rng, *pile(rng, 6), points=2, mu=1.0)
    assert -MORE_ROUNDS <= solve(a.floats, a.integers, 0, len(x)) < 0
    assert violation(a, J, np.array(a["x"])) < 1e-8


def test_an_island_of_too_many_trees_is_left_alone(solve):
    count = MOST_TREES + 1
    touching = [(0, -1), *((k, k - 1) for k in range(1, count))]
    a, _, x, _ = problem(np.random.default_rng(7), [6] * count, touching, points=1)
    a["before"][:] = x
    assert solve(a.floats, a.integers, 0, len(x)) == 0
