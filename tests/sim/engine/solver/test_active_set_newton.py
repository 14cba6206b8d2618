"""The impulses that the solver finds obey the law."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.reference_engine.shared_kernels import find_impulses
from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.kernel_cache import load_compiled
from urdfkit.sim.engine.simulation_memory import FOUND_ROWS, GUESSES, allocate

pytestmark = pytest.mark.slow  # in a fresh checkout: the function of the tests is compiled first


def solved(A, g, low, high, mu, before=None):
    n = len(g)
    arrays = allocate([1, 6, 7, 0, 0, 0, 0, n, 0, 1, 36, 6 * n, n * n, 0, 0, 0, 0, 0], width=6)
    arrays["A"][:], arrays["g"][:], arrays["low"][:], arrays["high"][:], arrays["mu"][:] = A.ravel(), g, low, high, mu
    if before is not None:
        arrays["before"][:] = before
    find = load_compiled(find_impulses, ("floats", "integers", "count"))
    return find(arrays.floats, arrays.integers, n), np.array(arrays["x"])


def violation(A, g, low, high, mu, x):
    """Return by how much the law is broken [m/s or N·s], the worst row."""
    w = A @ x + g
    worst = max(0.0, (low - x).max(), (x - high).max())
    k = 0
    while k < len(g):
        # Where it is not at a bound, nothing moves; at the bound, it moves away from it.
        if mu[k] > 0.0:
            worst = max(worst, -w[k], min(w[k], x[k]))
            most, force = mu[k] * x[k], x[k + 1 : k + 3]
            slip = w[k + 1 : k + 3]
            size, speed = np.linalg.norm(force), np.linalg.norm(slip)
            worst = max(worst, size - most, min(speed, most - size))
            if speed > 1e-6 and most > 1e-6:
                worst = max(worst, min(speed, np.linalg.norm(force / size + slip / speed) * most) if size else speed)
            k += 3
            continue
        worst = max(worst, min(w[k], x[k] - low[k]), min(-w[k], high[k] - x[k]))
        k += 1
    return worst


def rows_of(engine):
    a = engine.arrays
    n = int(a["counts"][FOUND_ROWS])
    A = a["A"][: n * n].reshape(n, n)
    return A, a["g"][:n], a["low"][:n], a["high"][:n], a["mu"][:n], a["x"][:n]


@pytest.mark.parametrize(("model", "height"), [("diff_drive", 0.06), ("box", 0.05), ("can", 0.15), ("ball", 0.1)])
def test_what_a_step_finds_obeys_the_law(engine_of, model, height):
    engine = engine_of(model, surfaces={"body": Surface(0.4, 0.4), "base": Surface(0.2, 0.2)})
    random = np.random.default_rng(5)
    nv = engine.kinematics.model.nv
    violations = {"direct": [], "iterated": []}
    for _ in range(300):
        q = engine.kinematics.neutral()
        q[2] = height - 1e-4 * random.random()
        engine.reset(q, random.choice([0.0, 0.02, 1.0]) * random.normal(size=nv))
        if model == "diff_drive":
            engine.motor_effort[6:], engine.motor_velocity[6:] = random.uniform(0.0, 2.0, 2), random.normal(size=2)
        engine.step()
        rows = rows_of(engine)
        if len(rows[1]):
            violations["iterated" if engine.iterated else "direct"].append(violation(*rows))
    assert len(violations["direct"]) > 80
    assert max(violations["direct"]) < 1e-8
    # The iteration is for blows out of the blue, as these are; it stops when it hardly moves.
    assert np.median(violations["iterated"] or [0.0]) < 1e-6
    assert max(violations["iterated"], default=0.0) < 1e-3


def test_a_known_load_is_shared_by_redundant_rows():
    J = np.ones((4, 1))
    A, g = J @ J.T / 2.0, np.full(4, -0.01)
    guesses, x = solved(A, g, np.zeros(4), np.full(4, np.inf), np.zeros(4))
    assert guesses == 1
    assert x == pytest.approx(np.full(4, 0.005), rel=1e-6)


@pytest.mark.parametrize("n", [1, 15, 16, 17, 33])
@pytest.mark.parametrize("limited", [False, True])
def test_rows_that_hold_are_one_linear_system(n, limited):
    random = np.random.default_rng(n)
    J = random.normal(size=(n, n + 5))
    A, g = J @ J.T, random.normal(size=n)
    low, high = np.full(n, -np.inf), np.full(n, np.inf)
    softness = 1e-9 * np.diag(A)
    expected = np.linalg.solve(A + np.diag(softness), -g)
    if limited:
        # Every fourth has half of what it would take.
        high[::4] = 0.5 * np.abs(expected[::4])
        low[::4] = -high[::4]
    guesses, x = solved(A, g, low, high, np.zeros(n))
    assert guesses > 0
    assert violation(A, g, low, high, np.zeros(n), x) < 2.0 * (softness * np.abs(x)).max()
    assert limited or x == pytest.approx(expected, rel=1e-9)


def test_a_remembered_load_lets_nothing_creep():
    A, g = np.array([[0.5]]), np.array([-0.01])
    fresh = solved(A, g, np.zeros(1), np.full(1, np.inf), np.zeros(1))[1]
    again = solved(A, g, np.zeros(1), np.full(1, np.inf), np.zeros(1), before=fresh)[1]
    assert abs(A @ again + g)[0] < 0.02 * abs(A @ fresh + g)[0]


def brute_force(A, g, low, high, mu, sweeps=200_000):
    """Return impulses from long projected Gauss-Seidel sweeps, and by how much they break the law."""
    x = np.zeros(len(g))
    for k in range(sweeps):
        i = 0
        old = x.copy()
        while i < len(g):
            x[i] = min(high[i], max(low[i], x[i] - (A[i] @ x + g[i]) / A[i, i]))
            if mu[i] > 0.0:
                t = slice(i + 1, i + 3)
                x[t] -= (A[t] @ x + g[t]) / max(A[i + 1, i + 1], A[i + 2, i + 2])
                size = np.linalg.norm(x[t])
                if size > mu[i] * x[i]:
                    x[t] *= mu[i] * x[i] / size
                i += 3
            else:
                i += 1
        if k % 100 == 0 and np.abs(x - old).max() < 1e-15:
            break
    return x, violation(A, g, low, high, mu, x)


def problem(seed, contacts, motors, dofs, *, friction=1.0):
    """Return rows of random contacts and motors on a body of so many dofs, which moves at random."""
    random = np.random.default_rng(seed)
    n = motors + 3 * contacts
    J = random.normal(size=(n, dofs))
    g = J @ random.normal(size=dofs)
    low, high, mu = np.full(n, -np.inf), np.full(n, np.inf), np.zeros(n)
    high[:motors] = random.uniform(0.01, 1.0, motors)
    low[:motors] = -high[:motors]
    low[motors::3] = 0.0
    mu[motors::3] = friction * random.uniform(0.05, 1.0, contacts)
    return J @ J.T / dofs, g, low, high, mu


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.integers(0, 2**32), st.integers(1, 4), st.integers(0, 3))
def test_random_contacts_obey_coulomb(seed, contacts, motors):
    rows = problem(seed, contacts, motors, dofs=3 * contacts + motors + 2)
    guesses, x = solved(*rows)
    assert guesses != 0
    assert violation(*rows, x) < 1e-8 * max(1.0, np.abs(x).max())


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.integers(0, 2**32), st.integers(2, 4))
def test_redundant_contacts_obey_coulomb(seed, contacts):
    rows = problem(seed, contacts, 0, dofs=6, friction=0.5)
    guesses, x = solved(*rows)
    assert guesses != 0
    assert violation(*rows, x) < 1e-7 * max(1.0, np.abs(x).max())


@pytest.mark.parametrize("seed", range(12))
def test_brute_force_finds_the_same(seed):
    rows = problem(seed, 2, 1, dofs=9, friction=0.6)
    guesses, x = solved(*rows)
    expected, off = brute_force(*rows)
    assert off < 1e-10
    assert guesses > 0
    assert x == pytest.approx(expected, abs=1e-7)


def test_a_wedged_peg_stays():
    # Between two walls that face each other, pressed apart by nothing: friction may be anything, gravity pulls at it.
    normals, up = np.array([[1.0, 0, 0], [-1.0, 0, 0]]), np.array([0.0, 0.0, 1.0])
    J = np.array([row for normal in normals for row in (normal, np.cross(up, normal), up)])
    A, g = J @ J.T, J @ np.array([0.0, 0.0, -0.01])
    low, high = np.tile([0.0, -np.inf, -np.inf], 2), np.full(6, np.inf)
    before = np.array([0.05, 0.0, 0.0, 0.05, 0.0, 0.0])
    guesses, x = solved(A, g, low, high, np.tile([1.0, 0.0, 0.0], 2), before)
    assert guesses != 0
    assert np.abs(A @ x + g).max() < 1e-8


def test_friction_of_a_contact_in_the_air_is_zero():
    A, g = np.eye(3), np.array([0.5, 1.0, 0.0])
    guesses, x = solved(A, g, np.array([0.0, -np.inf, -np.inf]), np.full(3, np.inf), np.array([0.7, 0.0, 0.0]))
    assert guesses == 1
    assert x.tolist() == [0.0, 0.0, 0.0]


def test_slip_that_turns_is_found_by_newton():
    # One contact: friction turns the slip, because the body yields more along y than along x.
    A, g = np.diag([1.0, 1.0, 3.0]), np.array([-0.2, 1.0, 1.0])
    mu = np.array([0.5, 0.0, 0.0])
    guesses, x = solved(A, g, np.array([0.0, -np.inf, -np.inf]), np.full(3, np.inf), mu)
    w = A @ x + g
    assert 0 < guesses <= 8
    assert x[0] == pytest.approx(0.2, rel=1e-8)
    assert x[1:] == pytest.approx(-0.1 * w[1:] / np.linalg.norm(w[1:]), rel=1e-8)


def test_turning_on_the_spot_takes_no_sweeps(engine_of):
    engine = engine_of("four_wheels")
    for dof, speed in ((6, -3.0), (7, -3.0), (8, 3.0), (9, 3.0)):
        engine.motor_velocity[dof], engine.motor_effort[dof] = speed, 50.0
    engine.step(2000)
    assert engine.iterated == 0
    assert abs(engine.v[5]) > 0.3
    violations = []
    for _ in range(50):
        engine.step()
        violations.append(violation(*rows_of(engine)))
        assert 0 < engine.arrays["counts"][GUESSES] <= 2
    assert max(violations) < 1e-9
