"""How contacts that slide share a load that rigid bodies leave open."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.engine.solver.test_active_set_newton import problem, solved, violation


def cart(*, load: float = 0.0):
    """Return rows of four points of a body that slides along x; a wheel that turns at `load` drives two of them."""
    places = np.array([[0.2, 0.3], [0.2, -0.3], [-0.2, 0.3], [-0.2, -0.3]])
    J = np.zeros((12, 7))
    for k, (x, y) in enumerate(places):
        # Twist of the body (vx vy vz wx wy wz) about its centre, 0.3 above the ground, and a wheel on two of them.
        J[3 * k] = [0, 0, 1, y, -x, 0, 0]
        J[3 * k + 1] = [1, 0, 0, 0, -0.3, -y, 0]
        J[3 * k + 2] = [0, 1, 0, 0.3, 0, x, 0]
    J[1, 6], J[4, 6] = 0.1, -0.1
    inverse = np.diag([0.2, 0.2, 0.2, 3.0, 2.0, 2.0, 500.0])
    v = np.array([1.0, 0.2, -0.01, 0.0, 0.0, 0.3, load])
    low, mu = np.tile([0.0, -np.inf, -np.inf], 4), np.tile([0.5, 0.0, 0.0], 4)
    return J @ inverse @ J.T, J @ v, low, np.full(12, np.inf), mu


@pytest.mark.parametrize("load", [0.0, 3.0])
def test_rounding_does_not_decide_who_carries_what(load):
    A, g, low, high, mu = cart(load=load)
    random = np.random.default_rng(0)
    before = np.tile([0.012, 0.0, 0.0], 4) * random.uniform(0.5, 1.5, 12)
    guesses, x = solved(A, g, low, high, mu, before)
    assert guesses > 0
    assert violation(A, g, low, high, mu, x) < 1e-12
    for _ in range(20):
        noise = 1e-14 * np.abs(A).max() * random.normal(size=A.shape)
        assert solved(A + noise + noise.T, g, low, high, mu, before)[1] == pytest.approx(x, abs=1e-10)


def test_of_all_loads_that_do_the_same_the_nearest_to_the_last_is_taken():
    A, g, low, high, mu = cart()
    before = np.zeros(12)
    before[::3] = 0.013, 0.012, 0.012, 0.013
    x = solved(A, g, low, high, mu, before)[1]
    assert x[::3].min() > 0.0
    idle = np.zeros(12)
    idle[::3] = 1.0, -1.0, -1.0, 1.0
    assert np.abs(idle @ A).max() < 1e-15
    # The softness is measured from 0.999 of the last impulses.
    assert idle @ (np.diag(A) * (x - 0.999 * before)) == pytest.approx(0.0, abs=1e-15)


def test_who_stands_too_high_carries_nothing():
    A, g, low, high, mu = cart()
    g = g.copy()
    g[0] += 1e-7
    guesses, x = solved(A, g, low, high, mu)
    assert guesses > 0
    assert violation(A, g, low, high, mu, x) < 1e-12
    assert min(x[0], x[9]) == 0.0


@pytest.mark.parametrize("seed", range(20))
def test_noise_changes_random_heaps_no_more_than_it_is(seed):
    A, g, low, high, mu = problem(seed, 3, 0, dofs=6, friction=0.5)
    guesses, x = solved(A, g, low, high, mu)
    assert guesses != 0
    noise = 1e-15 * np.random.default_rng(seed).normal(size=A.shape)
    A = A + noise + noise.T
    assert np.abs(A @ (solved(A, g, low, high, mu)[1] - x)).max() < 1e-9
