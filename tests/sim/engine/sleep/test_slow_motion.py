"""Islands of free bodies sleep when their motion has died down, and keep a slow motion that is real."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.sim.engine.worlds import ball, can, cube, rover, slab

G = 9.81
X = 3.0
"""Where the bodies are, away from the robot [m]."""


def tilted(body, angle, height):
    """Return a body turned about the y axis, with its centre at a height."""
    x, y, _ = body.pose[:3]
    return replace(body, pose=(x, y, height, 0.0, np.sin(angle / 2.0), 0.0, np.cos(angle / 2.0)))


def axis(body, k):
    """Return an axis of a body in the world."""
    x, y, z, w = body.pose[3:]
    rows = (
        (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
        (2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
        (2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
    )
    return np.array(rows[k])


@pytest.mark.parametrize(("past", "face"), [(0.01, 0), (-0.01, 2)])
def test_a_box_on_its_edge_a_hundredth_of_a_degree_from_balance_tips(engine_of, past, face):
    angle = np.radians(45.0 + past)
    box = tilted(cube("box", (X, 0.0, 0.0)), angle, 0.1 * (np.cos(angle) + np.sin(angle)))
    engine = rover(engine_of, bodies=[box])
    engine.step(3000)
    assert engine.bodies["box"].asleep
    assert engine.bodies["box"].pose[2] == pytest.approx(0.1, abs=1e-4)
    assert abs(axis(engine.bodies["box"], face)[2]) == pytest.approx(1.0, abs=1e-6)


def test_a_box_that_leans_on_a_heap_tips_although_the_rest_lies_still(engine_of):
    angle = np.radians(45.01)
    lies = slab("lies", (X, 0.0, 0.05), (0.6, 0.6, 0.1), mass=1.0, inertia=np.eye(3) * 0.03)
    box = tilted(cube("box", (X, 0.0, 0.0)), angle, 0.1 + 0.1 * (np.cos(angle) + np.sin(angle)))
    engine = rover(engine_of, bodies=[lies, box])
    engine.step(3000)
    assert abs(axis(engine.bodies["box"], 0)[2]) == pytest.approx(1.0, abs=1e-6)
    assert all(body.asleep for body in engine.bodies.values())


def test_a_row_of_dominoes_falls(engine_of):
    thick, high, count = 0.02, 0.2, 6
    inertia = np.diag([0.04 + 0.01, thick**2 + 0.04, thick**2 + 0.01]) * 0.2 / 12.0
    row = [
        slab(f"domino{k}", (X + 0.08 * k, 0.0, high / 2.0), (thick, 0.1, high), mass=0.2, inertia=inertia)
        for k in range(count)
    ]
    past = np.arctan2(thick, high) + np.radians(0.01)
    row[0] = tilted(row[0], past, (high * np.cos(past) + thick * np.sin(past)) / 2.0)
    engine = rover(engine_of, bodies=row)
    engine.step(4000)
    for k in range(count):
        assert axis(engine.bodies[f"domino{k}"], 2)[2] < 0.6


@pytest.mark.parametrize("speed", [0.0011, 0.008])
def test_a_box_that_carries_another_glides_on(engine_of, speed):
    boxes = [cube("box", (X, 0.0, 0.1), mu=0.0), cube("load", (X, 0.0, 0.3))]
    engine = rover(engine_of, bodies=boxes)
    for body in engine.bodies.values():
        body.place(body.pose, (speed, 0.0, 0.0, 0.0, 0.0, 0.0))
    engine.step(4000)
    for body in engine.bodies.values():
        assert body.pose[0] - X == pytest.approx(4.0 * speed, rel=1e-6)


def test_a_ball_placed_on_a_tenth_of_a_degree_rolls_down(engine_of):
    angle = np.radians(0.1)
    down = (G * np.sin(angle), 0.0, -G * np.cos(angle))
    engine = rover(engine_of, bodies=[ball("ball", (X, 2.0, 0.1))], gravity=down)
    engine.step(4000)
    assert engine.bodies["ball"].pose[0] - X == pytest.approx(0.5 * 5.0 / 7.0 * down[0] * 16.0, rel=1e-3)


@pytest.mark.parametrize("seconds", [0.0, 2.0])
@pytest.mark.parametrize("beyond", [0.01, -0.01])
def test_a_block_slides_a_hundredth_of_a_degree_above_the_angle_of_friction(engine_of, seconds, beyond):
    mu = 0.5
    angle = np.arctan(mu) + np.radians(beyond)
    # Outside the path of the robot, which rolls down.
    engine = rover(engine_of, bodies=[cube("block", (X, 2.0, 0.1), mu=mu)])
    engine.step(round(1000 * seconds))
    assert engine.bodies["block"].asleep is (seconds > 0.0)
    engine.arrays["gravity"][:] = G * np.sin(angle), 0.0, -G * np.cos(angle)
    engine.step(4000)
    acceleration = max(0.0, float(G * (np.sin(angle) - mu * np.cos(angle))))
    assert engine.bodies["block"].asleep is (acceleration == 0.0)
    assert engine.bodies["block"].pose[0] - X == pytest.approx(0.5 * acceleration * 16.0, rel=1e-2, abs=1e-6)


def test_a_box_that_a_robot_pushes_at_a_millimetre_a_second_moves_with_it(engine_of):
    engine = rover(engine_of, bodies=[cube("box", (0.3, 0.0, 0.1), mass=0.2, mu=0.2)])
    engine.motor_effort[6:] = 5.0
    box = engine.bodies["box"]
    engine.motor_velocity[6:] = 1.0
    while box.pose[0] < 0.301:
        engine.step(10)
        assert engine.t < 5.0
    engine.motor_velocity[6:] = 0.02
    engine.step(1000)
    before, drives = box.pose[0], engine.q[0]
    engine.step(4000)
    assert engine.q[0] - drives > 3e-3
    assert box.pose[0] - before == pytest.approx(engine.q[0] - drives, rel=1e-2)


@pytest.mark.parametrize("speed", [0.3, 0.05])
def test_a_can_with_a_heavy_side_continues_to_rock(engine_of, speed):
    radius, half = 0.05, 0.5**0.5
    rocker = replace(
        can("can", (X, 0.0, radius)), centre=(0.0, -0.02, 0.0), pose=(X, 0.0, radius, half, 0.0, 0.0, half)
    )
    engine = rover(engine_of, bodies=[rocker])
    body = engine.bodies["can"]
    body.place(body.pose, (speed * radius, 0.0, 0.0, 0.0, speed, 0.0))
    engine.step(5000)
    assert not body.asleep
    fastest = 0.0
    for _ in range(100):
        engine.step(10)
        fastest = max(fastest, abs(body.twist[4]))
    assert fastest == pytest.approx(speed, rel=0.05)


@pytest.mark.parametrize("speed", [0.049, 0.015])
def test_a_ball_that_rolls_slowly_and_evenly_on_the_ground_slows_down_and_sleeps(engine_of, speed):
    engine = rover(engine_of, bodies=[ball("ball", (X, 2.0, 0.1))])
    body = engine.bodies["ball"]
    body.place(body.pose, (speed, 0.0, 0.0, 0.0, speed / 0.1, 0.0))
    engine.step(490)
    assert body.twist[0] == pytest.approx(speed, rel=1e-6)
    before, least = speed, 0.0
    for _ in range(200):
        engine.step(10)
        # It never stops from one step to the next: 0.01·m·g·r against 1.4·m·r² takes 0.07 m/s².
        least = min(least, body.twist[0] - before)
        before = body.twist[0]
    assert body.asleep
    assert least == pytest.approx(-0.01 * 0.01 * G / 1.4, rel=1e-2)
    distance = 0.5 * speed + 0.5 * speed**2 / (0.01 * G / 1.4)
    assert body.pose[0] - X == pytest.approx(distance, rel=2e-2)


def test_without_sleep_a_ball_rolls_on_slowly(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", (X, 2.0, 0.1))], sleep=False)
    body = engine.bodies["ball"]
    body.place(body.pose, (0.02, 0.0, 0.0, 0.0, 0.2, 0.0))
    engine.step(3000)
    assert body.twist[0] == pytest.approx(0.02, rel=1e-6)


@pytest.mark.parametrize("degrees", [0.02, 0.1, 0.3, 1.0])
@pytest.mark.parametrize("up", [0.0, 0.04])
def test_a_ball_that_rolls_up_a_slope_turns_back(engine_of, degrees, up):
    angle = np.radians(degrees)
    engine = rover(
        engine_of, bodies=[ball("ball", (X, 2.0, 0.1))], gravity=(G * np.sin(angle), 0.0, -G * np.cos(angle))
    )
    body = engine.bodies["ball"]
    body.place(body.pose, (-up, 0.0, 0.0, 0.0, -up / 0.1, 0.0))
    downhill = 5.0 / 7.0 * G * np.sin(angle)
    seconds = 4.0 + round(2.0 * up / downhill)
    engine.step(1000 * int(seconds))
    assert body.twist[0] == pytest.approx(downhill * seconds - up, rel=1e-3)


def test_a_ball_at_rest_on_the_ground_rolls_down_when_gravity_tilts(engine_of):
    for steps in (100, 2000):
        engine = rover(engine_of, bodies=[ball("ball", (X, 2.0, 0.1))])
        engine.step(steps)
        assert engine.bodies["ball"].asleep is (steps == 2000)
        angle = np.radians(0.1)
        engine.arrays["gravity"][:] = G * np.sin(angle), 0.0, -G * np.cos(angle)
        engine.step(3000)
        downhill = 5.0 / 7.0 * G * np.sin(angle)
        assert engine.bodies["ball"].pose[0] - X == pytest.approx(0.5 * downhill * 9.0, rel=1e-2)


def test_a_ball_that_is_pushed_slowly_follows_the_push(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", (X, 2.0, 0.1))])
    body = engine.bodies["ball"]
    body.place(body.pose, (0.02, 0.0, 0.0, 0.0, 0.2, 0.0))
    # About the axis of its rolling, which stays the same in its own axes while it rolls.
    body.push((0.0, 0.0, 0.0, 0.0, 1e-4, 0.0))
    engine.step(3000)
    assert body.twist[0] == pytest.approx(0.02 + 3.0 * 1e-4 / 0.1 / 1.4, rel=1e-3)


def test_a_wheel_of_a_robot_that_rolls_slowly_rolls_on(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", (X, 2.0, 0.1))])
    engine.motor_effort[6:] = 5.0
    engine.motor_velocity[6:] = 0.2
    engine.step(1000)
    before = engine.q[0]
    engine.step(1000)
    first = engine.q[0] - before
    engine.step(3000)
    assert first > 1e-3
    assert engine.q[0] - before == pytest.approx(4.0 * first, rel=1e-3)


@pytest.mark.parametrize(("carried", "sleeps"), [(True, True), (False, False)])
def test_a_body_that_turns_in_place_sleeps_in_a_heap_and_turns_on_alone(engine_of, carried, sleeps):
    # Without friction, as point contacts have none against this rotation; the fastest corner moves at 4 mm/s.
    lies = slab("lies", (X, 0.0, 0.05), (0.6, 0.6, 0.1), mass=1.0, inertia=np.eye(3) * 0.03)
    box = cube("box", (X, 0.0, 0.2 if carried else 0.1), mu=0.0)
    engine = rover(engine_of, bodies=[lies, box] if carried else [box])
    body = engine.bodies["box"]
    body.place(body.pose, (0.0, 0.0, 0.0, 0.0, 0.0, 0.025))
    engine.step(4000)
    assert body.asleep == sleeps
    assert body.twist[5] == pytest.approx(0.0 if sleeps else 0.025, rel=1e-6)
