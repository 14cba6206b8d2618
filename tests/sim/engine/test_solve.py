"""The impulses that the solver finds obey the law."""

from __future__ import annotations

import numpy as np
import pytest

from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.arrays import FOUND_ROWS, allocate
from urdfkit.sim.engine.parts import find_impulses
from urdfkit.sim.engine.warmup import load_compiled


def solved(A, g, low, high, mu, before=None):
    n = len(g)
    arrays = allocate([1, 6, 7, 0, 0, 0, 0, n, 0, 1, 36, 6 * n, n * n, 0, 0, 0], width=6)
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
    a = engine._arrays
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


def test_a_remembered_load_lets_nothing_creep():
    A, g = np.array([[0.5]]), np.array([-0.01])
    fresh = solved(A, g, np.zeros(1), np.full(1, np.inf), np.zeros(1))[1]
    again = solved(A, g, np.zeros(1), np.full(1, np.inf), np.zeros(1), before=fresh)[1]
    assert abs(A @ again + g)[0] < 0.02 * abs(A @ fresh + g)[0]
