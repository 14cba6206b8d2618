"""Rolling resistance: what lies in a heap comes to rest, and what rolls by itself or is pushed rolls freely."""

from __future__ import annotations

import numpy as np
import pytest

from tests.sim.engine.worlds import ball, cube, rover, slab

BALL = (2.0, 1.0, 0.1)
"""Where the ball touches the ground and the box beside it."""
BOX = (2.2, 1.0, 0.1)


def test_a_ball_that_turns_on_the_spot_against_a_box_comes_to_rest(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", BALL), cube("box", BOX)])
    body = engine.bodies["ball"]
    body.place(body.pose, (0.0, 0.0, 0.0, 0.0, 0.0, 2.0))
    engine.step(200)
    # Of 2 rad/s, 0.01·m·g·r over 0.4·m·r² takes 2.45 rad/s².
    assert body.twist[5] == pytest.approx(2.0 - 0.2 * 0.01 * 9.81 / (0.4 * 0.1), abs=0.02)
    engine.step(1500)
    assert body.asleep
    assert body.pose[:3] == pytest.approx(BALL, abs=1e-3)


@pytest.mark.parametrize("speed", [0.06, 0.1])
def test_a_ball_rolls_freely_on_a_fixed_board_and_comes_to_rest_on_a_free_one(engine_of, speed):
    for static in (True, False):
        board = slab("board", (2.0, 1.0, 0.025), (1.0, 0.5, 0.05), static=static)
        engine = rover(engine_of, bodies=[ball("ball", (2.0, 1.0, 0.15)), board])
        body = engine.bodies["ball"]
        body.place(body.pose, (speed, 0.0, 0.0, 0.0, speed / 0.1, 0.0))
        engine.step(100)
        # 0.01·m·g·r against the inertia about the contact, 1.4·m·r².
        slower = 0.0 if static else 0.1 * 0.01 * 9.81 / 1.4
        assert body.twist[0] == pytest.approx(speed - slower, rel=1e-6 if static else 1e-2)
        engine.step(1900)
        assert body.asleep is not static


def test_a_ball_that_rolls_and_turns_about_its_normal_rolls_on_and_ceases_to_turn(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", BALL)])
    body = engine.bodies["ball"]
    body.place(body.pose, (0.06, 0.0, 0.0, 0.0, 0.6, 1.0))
    engine.step(200)
    assert body.twist[5] == pytest.approx(1.0 - 0.2 * 0.01 * 9.81 / (0.4 * 0.1), abs=0.02)
    engine.step(1800)
    assert abs(body.twist[5]) < 1e-6
    assert np.hypot(*body.twist[:2]) == pytest.approx(0.06, rel=1e-3)


def test_a_ball_that_is_pushed_against_a_box_rolls_as_without_resistance(engine_of):
    speeds = []
    for bodies in ([ball("ball", BALL)], [ball("ball", BALL), cube("box", (2.2 + 1e-6, 1.0, 0.1), mu=0.0)]):
        engine = rover(engine_of, bodies=bodies)
        engine.bodies["ball"].push((0.0, 0.2, 0.0, 0.0, 0.0, 0.0))
        engine.step(500)
        speeds.append(engine.bodies["ball"].twist[1])
    assert speeds[1] == pytest.approx(speeds[0], rel=1e-6)
    # It is pushed along its own axes, which turn a little.
    assert speeds[0] == pytest.approx(0.5 * 0.2 / 1.4, rel=5e-3)


@pytest.mark.parametrize(
    ("static", "turning", "resisted"), [(False, 0.5, True), (False, 0.7, False), (True, 0.5, False)]
)
def test_a_slow_smooth_box_that_turns_on_a_free_board_is_slowed_down_about_its_normal(
    engine_of, static, turning, resisted
):
    board = slab("board", (2.0, 1.0, 0.025), (1.0, 0.5, 0.05), static=static)
    engine = rover(engine_of, bodies=[cube("box", (2.0, 1.0, 0.15), mu=0.0), board])
    body = engine.bodies["box"]
    body.place(body.pose, (0.0, 0.0, 0.0, 0.0, 0.0, turning))
    engine.step(100)
    # 0.01·m·g·r, r half the diagonal, against m·a²/6: the corners must be slower than 0.1 m/s.
    slower = 0.1 * 0.01 * 9.81 * 0.1 * np.sqrt(3.0) / (0.04 / 6.0) if resisted else 0.0
    assert body.twist[5] == pytest.approx(turning - slower, abs=1e-3)
