"""One robot of an engine: what it met, what it is given, and how steps are counted."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.engine.worlds import SMOOTH, ball, rover, start
from urdfkit.errors import SimulationError
from urdfkit.scene import scene_of
from urdfkit.sim.engine.bodies import Member


def test_the_ground_is_nothing_to_be_taken_back_for(engine_of):
    engine = rover(engine_of)
    engine.step(20)
    assert engine.contacts()
    assert not engine._met_something()


def test_only_who_touches_it_met_something(engine_of):
    probe = engine_of("diff_drive")
    other = Member(probe.kinematics, scene_of(probe.kinematics.robot).shapes, SMOOTH, name="other")
    near = ball("ball", (0.26, 0.0, 0.1))
    engine = engine_of("diff_drive", surfaces=SMOOTH, others=[other], bodies=[near])
    first, second = engine.robots
    first.put(start(engine))
    second.put(start(engine, x=5.0))
    first.motor_velocity[6:], first.motor_effort[6:] = 5.0, 1.0
    for _ in range(400):
        engine.step()
        if first._met_something():
            break
    assert any(contact.b == "ball" for contact in engine.contacts())
    assert first._met_something()
    assert not second._met_something()


def test_time_is_the_steps_made(engine_of):
    engine = rover(engine_of)
    engine.step(3)
    engine.mass_matrix()  # an evaluation is no step
    assert (engine.steps, engine.t) == (3, pytest.approx(0.003))
    engine.reset(start(engine))
    assert (engine.steps, engine.t) == (0, 0.0)
    engine.step(2)
    engine.applied[6:] = np.nan
    with pytest.raises(SimulationError, match=r"at t = 0\.003 s"):
        engine.step(5)
    assert engine.steps == 2
