"""What is at rest sleeps, tells what it rests on, and wakes when something happens to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.sim.engine.worlds import ball, can, cube, rover, rovers, slab, start
from urdfkit.sim.engine.simulation_memory import FOUND_CONTACTS, FOUND_ROWS

G = 9.81


def stack(count=3, x=1.0):
    return [cube(f"box{k}", (x, 0.0, 0.1 + 0.2 * k)) for k in range(count)]


def load_between(engine, a, b):
    return sum(c.force[2] for c in engine.contacts() if (c.a, c.b) == (a, b))


def sleeping(engine):
    return [name for name, body in engine.bodies.items() if body.asleep]


def test_a_stack_falls_asleep_and_stays_where_it_is(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.step(400)
    assert not sleeping(engine)
    engine.step(600)
    assert sleeping(engine) == ["box0", "box1", "box2"]
    poses = [body.pose for body in engine.bodies.values()]
    engine.step(10_000)
    assert [body.pose for body in engine.bodies.values()] == poses
    assert engine.bodies["box0"].twist == (0.0,) * 6
    assert engine.t == pytest.approx(11.0)
    assert engine.arrays["counts"][FOUND_ROWS] == 0


def test_the_contacts_of_what_sleeps_are_still_told(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.motor_velocity[6:], engine.motor_effort[6:] = -1.0, 1.0
    engine.step(300)
    awake = engine.contacts()
    engine.step(1000)
    assert sleeping(engine)
    assert len(engine.contacts()) == len(awake)
    assert load_between(engine, "box0", "box1") == pytest.approx(-2.0 * G, rel=1e-6)
    assert load_between(engine, "box0", "ground_plane") == pytest.approx(3.0 * G, rel=1e-6)


def test_without_sleep_nothing_sleeps(engine_of):
    engine = rover(engine_of, bodies=stack(), sleep=False)
    engine.step(1500)
    assert not sleeping(engine)
    assert engine.arrays["counts"][FOUND_CONTACTS] == 15


def test_waking_changes_nothing_that_rests(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.step(1000)
    before = [np.array(body.pose) for body in engine.bodies.values()]
    engine.wake()
    engine.step(1)
    assert not sleeping(engine)
    assert engine.iterated == 0
    assert load_between(engine, "box0", "box1") == pytest.approx(-2.0 * G, rel=1e-6)
    for body, pose in zip(engine.bodies.values(), before, strict=True):
        assert body.pose == pytest.approx(pose, abs=1e-10)
        assert np.abs(body.twist).max() < 1e-7
    engine.step(1000)
    assert sleeping(engine) == ["box0", "box1", "box2"]


def test_a_ball_that_rolls_into_a_sleeping_stack_wakes_all_of_it(engine_of):
    engine = rover(engine_of, bodies=[*stack(), *(cube(f"far{k}", (3.0, 1.0, 0.1 + 0.2 * k)) for k in range(2))])
    engine.bodies["box2"].place((1.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.0))
    engine.step(1000)
    assert len(sleeping(engine)) == 5
    again = rover(engine_of, bodies=[*stack(), ball("ball", (1.6, 0.0, 0.1), mass=3.0)])
    again.bodies["ball"].place((1.6, 0.0, 0.1, 0.0, 0.0, 0.0, 1.0), (-0.6, 0.0, 0.0, 0.0, -6.0, 0.0))
    again.step(600)
    assert sleeping(again) == ["box0", "box1", "box2"]
    again.step(100)
    assert not sleeping(again)
    assert again.bodies["box0"].pose[0] < 1.0 - 1e-4


def test_only_the_island_that_is_touched_wakes(engine_of):
    bodies = [*stack(), *(cube(f"far{k}", (3.0, 1.0, 0.1 + 0.2 * k)) for k in range(2))]
    engine = rover(engine_of, bodies=bodies)
    engine.step(1000)
    engine.bodies["far1"].push((0.0, 0.0, -5.0, 0.0, 0.0, 0.0))
    engine.step(10)
    assert sleeping(engine) == ["box0", "box1", "box2"]
    assert load_between(engine, "far0", "far1") == pytest.approx(-G - 5.0, rel=1e-3)
    # What is pushed does not sleep, however still it lies.
    engine.step(2000)
    assert sleeping(engine) == ["box0", "box1", "box2"]
    engine.bodies["far1"].push((0.0,) * 6)
    engine.step(1000)
    assert len(sleeping(engine)) == 5


def test_what_lost_its_support_falls(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.step(1000)
    engine.bodies["box0"].place((1.0, 3.0, 0.1, 0.0, 0.0, 0.0, 1.0))
    engine.step(100)
    assert engine.bodies["box1"].pose[2] == pytest.approx(0.3 - 0.5 * G * 0.01, abs=1e-4)
    assert engine.bodies["box2"].pose[2] == pytest.approx(0.5 - 0.5 * G * 0.01, abs=1e-4)


def test_gravity_wakes(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.step(1000)
    engine.arrays["gravity"][:] = 0.0, 0.0, 1.0
    engine.step(100)
    assert not sleeping(engine)
    assert engine.bodies["box2"].pose[2] > 0.504


def test_a_parked_robot_sleeps_and_drives_off_when_told(engine_of):
    states = []
    for sleep in (True, False):
        engine = rover(engine_of, bodies=stack(), sleep=sleep)
        engine.motor_effort[6:] = 1.0
        engine.step(1500)
        assert engine.asleep is sleep
        engine.motor_velocity[6:] = 5.0
        engine.step(500)
        assert not engine.asleep
        states.append(engine.q)
    assert states[0] == pytest.approx(states[1], abs=1e-9)
    assert states[0][0] > 0.1


def test_a_robot_whose_servo_holds_it_does_not_sleep(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.kp[6:], engine.kd[6:] = 10.0, 1.0
    engine.step(2000)
    assert not engine.asleep
    assert sleeping(engine)


def test_what_floats_at_rest_is_left_awake(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", (1.0, 0.0, 2.0))], gravity=(0.0, 0.0, 0.0))
    engine.step(1000)
    assert not sleeping(engine)


@pytest.mark.parametrize("steps", [1, 7, 500])
def test_sleepers_change_nothing_for_others_and_calls_of_any_length_are_the_same(engine_of, steps):
    states = []
    for sleep, chunk in ((False, 1500), (True, steps)):
        engine = rover(engine_of, bodies=stack(x=2.0), sleep=sleep)
        engine.motor_velocity[6:], engine.motor_effort[6:] = (-6.0, -4.0), 2.0
        for _ in range(1500 // chunk):
            engine.step(chunk)
        engine.step(1500 % chunk)
        assert bool(sleeping(engine)) is sleep
        states.append((engine.q.tobytes(), engine.v.tobytes()))
    assert states[0] == states[1]


def test_before_anything_sleeps_it_is_the_same_to_the_last_bit(engine_of):
    states = []
    for sleep in (True, False):
        engine = rover(engine_of, bodies=[*stack(), slab("board", (0.0, 0.0, 0.4), (0.5, 0.3, 0.02))], sleep=sleep)
        engine.step(450)
        assert not sleeping(engine)
        states.append(engine.arrays["s"].tobytes())
    assert states[0] == states[1]


def test_sleep_is_the_same_twice_to_the_last_bit(engine_of):
    states = []
    for _ in range(2):
        engine = rover(engine_of, bodies=[*stack(), ball("ball", (1.0, 0.02, 0.75))])
        engine.step(1200)
        engine.bodies["box2"].push((5.0, 0.0, 0.0, 0.0, 0.0, 0.0))
        engine.step(800)
        states.append(engine.arrays["s"].tobytes())
    assert states[0] == states[1]


def test_reset_wakes(engine_of):
    engine = rover(engine_of, bodies=stack())
    engine.step(1000)
    engine.reset(start(engine))
    assert not sleeping(engine)
    assert engine.contacts() == ()


def test_a_world_of_sleeping_robots_takes_no_rows(engine_of):
    engine = rovers(engine_of, 5)
    for robot in engine.robots:
        robot.motor_velocity[6:] = 0.0
    engine.step(1000)
    assert all(robot.asleep for robot in engine.robots)
    assert engine.arrays["counts"][FOUND_ROWS] == 0


def lying_can(name, at):
    """A can on its side, which rolls along x."""
    half = 0.5**0.5
    return replace(can(name, at), pose=(*at, half, 0.0, 0.0, half))


def test_what_rolls_down_one_degree_is_not_put_to_sleep(engine_of):
    angle = np.radians(1.0)
    down = (G * np.sin(angle), 0.0, -G * np.cos(angle))
    engine = rover(engine_of, bodies=[ball("ball", (1.0, 1.0, 0.1)), lying_can("can", (1.0, 2.0, 0.05))], gravity=down)
    engine.step(2000)
    for name, share in (("ball", 5 / 7), ("can", 2 / 3)):
        assert not engine.bodies[name].asleep
        assert engine.bodies[name].pose[0] - 1.0 == pytest.approx(0.5 * share * down[0] * 4.0, rel=1e-3)


@pytest.mark.parametrize("speed", [0.051, 0.2])
def test_what_rolls_faster_than_fifty_millimetres_a_second_rolls_on(engine_of, speed):
    engine = rover(engine_of, bodies=[ball("ball", (1.0, 1.0, 0.1)), lying_can("can", (1.0, 2.0, 0.05))])
    for name, radius in (("ball", 0.1), ("can", 0.05)):
        body = engine.bodies[name]
        body.place(body.pose, (speed, 0.0, 0.0, 0.0, speed / radius, 0.0))
    engine.step(2000)
    for name in ("ball", "can"):
        assert engine.bodies[name].twist[0] == pytest.approx(speed, rel=1e-6)


def test_a_ball_that_rolls_slowly_sleeps_after_a_second_and_a_box_that_glides_does_not(engine_of):
    engine = rover(engine_of, bodies=[ball("ball", (1.0, 1.0, 0.1)), cube("box", (1.0, 2.0, 0.1), mu=0.0)])
    for name in ("ball", "box"):
        body = engine.bodies[name]
        body.place(body.pose, (0.008, 0.0, 0.0, 0.0, 0.08 * (name == "ball"), 0.0))
    engine.step(999)
    assert not sleeping(engine)
    engine.step(1001)
    assert sleeping(engine) == ["ball"]
    # Without resistance for half a second, then with 0.01·m·g·r against 1.4·m·r².
    assert engine.bodies["ball"].pose[0] == pytest.approx(1.004 + 0.5 * 0.008**2 / (0.01 * G / 1.4), abs=1e-4)
    assert engine.bodies["box"].pose[0] == pytest.approx(1.016, abs=1e-6)


def test_a_heap_with_balls_and_cans_comes_to_sleep(engine_of):
    walls = [
        slab(f"wall{k}", (3.0 + 0.225 * x, 0.225 * y, 0.25), (0.05 if x else 0.5, 0.05 if y else 0.5, 1.0), static=True)
        for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)))
    ]
    makers = (lambda *a: cube(*a, side=0.1), lambda *a: ball(*a, radius=0.05), lying_can)
    things = [
        makers[k % 3](
            f"b{k}", (2.93 + 0.14 * (k % 2) + 0.01 * (k % 5), -0.07 + 0.14 * (k // 2 % 2), 0.1 + 0.13 * (k // 4))
        )
        for k in range(16)
    ]
    engine = rover(engine_of, bodies=[*walls, *things])
    for _ in range(40):
        engine.step(250)
        if len(sleeping(engine)) == len(things):
            break
    assert len(sleeping(engine)) == len(things)
    # What falls on it wakes it.
    engine.bodies["b0"].push((0.0, 0.0, 20.0, 0.0, 0.0, 0.0))
    engine.step(10)
    assert len(sleeping(engine)) < len(things)
