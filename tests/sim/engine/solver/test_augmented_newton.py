"""Robots on many contacts: few steps of Newton's method at rest, also where corrections contradict each other."""

from __future__ import annotations

import numpy as np
import pytest

from tests.bench.contact_rich.models import quadruped
from tests.bench.contact_rich.scenes import FOLDED
from tests.sim.engine.conftest import EngineOf
from urdfkit.sim.engine import Engine
from urdfkit.sim.engine.simulation_memory import GUESSES

WEIGHT = (10.0 + 4.0 * 1.8) * 9.81


def lying(engine_of: EngineOf) -> Engine:
    """Return a limp quadruped that lies on its legs, which are folded to their limits."""
    engine = engine_of(quadruped(0.1), sleep=False)
    engine.reset(engine.kinematics.configuration(FOLDED, base=np.array([0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0])))
    engine.step(5000)
    return engine


def newton_steps(engine: Engine, steps: int) -> list[int]:
    found = []
    for _ in range(steps):
        engine.step()
        found.append(int(engine.arrays["counts"][GUESSES]))
    return found


def test_attempts_that_fail_at_rest_are_skipped_in_most_steps(engine_of: EngineOf) -> None:
    engine = lying(engine_of)
    taken = newton_steps(engine, 170)
    assert min(taken) > 0
    assert np.mean(taken) < 4.0
    assert max(taken) > 5  # corrections are still attempted now and then
    assert np.abs(engine.v).max() < 1e-6
    assert sum(contact.force[2] for contact in engine.contacts()) == pytest.approx(WEIGHT, rel=1e-5)


def test_a_reset_engine_repeats_the_same_bytes(engine_of: EngineOf) -> None:
    engine = lying(engine_of)
    states = []
    for _ in range(2):
        engine.reset(engine.kinematics.configuration(FOLDED, base=np.array([0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0])))
        engine.step(700)
        states.append(engine.arrays["s"].tobytes() + engine.arrays["x"].tobytes())
    assert states[0] == states[1]
