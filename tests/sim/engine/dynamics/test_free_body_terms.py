"""Terms of a free body, written out: against those of any tree."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine.dynamics.free_body_terms import free_body_terms, has_factors
from urdfkit.sim.engine.dynamics.mass_matrix import FREE, place, terms
from urdfkit.sim.engine.interpreted_kernel import interpreted, views
from urdfkit.sim.engine.simulation_memory import LETTERS, allocate


def body(rng):
    """Return the arrays of a free body anywhere, with its centre of mass off its origin."""
    counts = dict.fromkeys(LETTERS, 1) | {"b": 1, "d": 6, "s": 7, "e": 36, "r": 6, "y": 36, "q": 36}
    a = allocate([counts[letter] for letter in LETTERS], width=6)
    a["kind"][:], a["parent"][:] = FREE, -1
    a["first_v"][:] = a["tree_dof"][:] = [0, 6]
    a["tree_body"][:], a["tree_floats"][:] = [0, 1], 1
    a["dof_row"][:], a["dof_parent"][:] = 6 * np.arange(6), np.arange(-1, 5)
    a["place_R"][:], a["subspace"][:] = np.eye(3).ravel(), np.eye(6)
    a["s"][:3], a["v"][:], a["gravity"][:] = rng.normal(size=3), rng.normal(size=6), rng.normal(size=3)
    turn = rng.normal(size=4)
    a["s"][3:] = turn / np.linalg.norm(turn)
    a["P"][:], a["mass"][:], a["centre"][:] = rng.normal(size=3), rng.uniform(0.1, 5.0), rng.normal(size=3)
    root = rng.normal(size=(3, 3))
    a["tensor"][:] = (root @ root.T)[np.triu_indices(3)]
    return a


@pytest.mark.parametrize("seed", range(5))
def test_they_are_those_of_any_tree(seed):
    a = body(np.random.default_rng(seed))
    w = views(a.floats, a.integers)
    interpreted(place.python)(w, 0, w.s, False)
    interpreted(terms.python)(w, 0)
    names = ("M", "bias", "twist")
    expected = {name: a[name].copy() for name in names}
    for name in names:
        a[name][:] = 0.0
    interpreted(free_body_terms.python)(w, 0)
    for name in names:
        assert a[name] == pytest.approx(expected[name], rel=1e-12, abs=1e-12), name


@pytest.mark.parametrize(("name", "entry"), [("mass", 0), ("centre", 2), ("tensor", 3)])
def test_m_is_factored_again_when_what_it_is_computed_from_changes(name, entry):
    a = body(np.random.default_rng(0))
    w = views(a.floats, a.integers)
    has = interpreted(has_factors.python)
    assert [has(w, 0, True) for _ in range(3)] == [False, True, True]
    a[name].reshape(-1)[entry] += 1e-9
    assert [has(w, 0, True) for _ in range(2)] == [False, True]


def test_m_is_factored_again_after_dampers():
    a = body(np.random.default_rng(0))
    w = views(a.floats, a.integers)
    has = interpreted(has_factors.python)
    assert [has(w, 0, undamped) for undamped in (True, True, False)] == [False, True, False]
    assert [has(w, 0, True) for _ in range(2)] == [False, True]
