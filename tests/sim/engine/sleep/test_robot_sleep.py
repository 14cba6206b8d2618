"""A robot that is alone on the ground sleeps at rest, and any change from outside wakes it."""

from __future__ import annotations

import numpy as np
import pytest

from tests.bench.contact_rich.models import quadruped
from tests.sim.engine.conftest import EngineOf
from tests.sim.engine.worlds import rover
from urdfkit.sim.engine import Engine

G = 9.81
WEIGHT = 5.8 * G


def parked(engine_of: EngineOf, **options: object) -> Engine:
    engine = rover(engine_of, **options)
    engine.motor_effort[6:] = 1.0
    return engine


def carried(engine: Engine) -> float:
    return sum(contact.force[2] for contact in engine.contacts())


def test_it_sleeps_after_half_a_second_where_it_is_and_reports_its_contacts(engine_of: EngineOf) -> None:
    engine = parked(engine_of)
    engine.step(400)
    assert not engine.asleep
    engine.step(200)
    assert engine.asleep
    coordinates, contacts = engine.coordinates.tobytes(), engine.contacts()
    engine.step(10_000)
    assert engine.coordinates.tobytes() == coordinates
    assert engine.contacts() == contacts
    assert carried(engine) == pytest.approx(WEIGHT, rel=1e-6)
    assert not engine.v.any()
    assert engine.t == pytest.approx(10.6)


def drive(engine: Engine) -> None:
    engine.motor_velocity[6:] = 5.0


def push(engine: Engine) -> None:
    engine.applied[0] = 60.0


def spring(engine: Engine) -> None:
    engine.kp[6:], engine.position_target[6:], engine.motor_effort[6:] = 5.0, 1.0, 0.0


def integrate(engine: Engine) -> None:
    engine.ki[6:], engine.i_max[6:], engine.i_min[6:] = 5.0, 1.0, -1.0
    engine.position_target[6:], engine.motor_effort[6:] = 1.0, 0.0


def approach(engine: Engine) -> None:
    engine.approach_rate[6:], engine.position_target[6:] = 10.0, 1.0


def tilt(engine: Engine) -> None:
    engine.arrays["gravity"][:] = 12.0, 0.0, -1.0


def lift(engine: Engine) -> None:
    q = engine.q
    q[2] += 0.1
    engine.put(q)


@pytest.mark.parametrize("change", [drive, push, spring, integrate, approach, tilt, lift])
def test_a_change_from_outside_wakes_it_and_it_moves_as_without_sleep(change, engine_of: EngineOf) -> None:
    states = []
    for sleep in (True, False):
        engine = parked(engine_of, sleep=sleep)
        engine.step(1000)
        assert engine.asleep is sleep
        start = engine.q
        change(engine)
        engine.step(100)
        assert not engine.asleep
        assert np.abs(engine.q - start).max() > 1e-3
        states.append(engine.q)
    assert states[0] == pytest.approx(states[1], abs=1e-9)


def test_what_is_put_where_it_was_wakes(engine_of: EngineOf) -> None:
    engine = parked(engine_of)
    engine.step(1000)
    engine.put(engine.q)
    engine.step()
    assert not engine.asleep
    assert carried(engine) == pytest.approx(WEIGHT, rel=1e-6)


def test_calls_of_any_length_give_the_same_bytes(engine_of: EngineOf) -> None:
    states = []
    for chunk in (1, 7, 900):
        engine = parked(engine_of)
        for steps in (chunk,) * (900 // chunk), (900 % chunk,):
            for count in steps:
                engine.step(count)
        assert engine.asleep
        engine.motor_velocity[6:] = -3.0
        engine.step(100)
        states.append(engine.arrays["s"].tobytes())
    assert len(set(states)) == 1


def test_without_sleep_or_under_a_servo_or_in_the_air_it_stays_awake(engine_of: EngineOf) -> None:
    restless = parked(engine_of, sleep=False)
    held = parked(engine_of)
    held.kp[6:], held.kd[6:] = 10.0, 1.0
    afloat = parked(engine_of, gravity=(0.0, 0.0, 0.0), ground=None)
    for engine in (restless, held, afloat):
        engine.step(1500)
        assert not engine.asleep


def test_a_robot_on_a_slope_that_slides_stays_awake(engine_of: EngineOf) -> None:
    angle = np.radians(0.5)
    engine = rover(engine_of, gravity=(G * np.sin(angle), 0.0, -G * np.cos(angle)))
    engine.step(1000)
    assert not engine.asleep
    assert engine.q[0] > 0.01


def test_a_quadruped_on_its_belly_sleeps(engine_of: EngineOf) -> None:
    engine = engine_of(quadruped(0.1))
    q = engine.kinematics.neutral()
    q[2] = 0.1
    engine.reset(q)
    engine.step(4000)
    assert engine.asleep
    assert carried(engine) == pytest.approx((10.0 + 4.0 * 1.8) * G, rel=1e-6)
