"""Heaps in which contacts slide: how they are solved, that they only lose energy, and what has no room."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from tests.sim.engine.worlds import ball, cube, rover, slab
from urdfkit.sim.engine.constraints.contact_rows import FASTEST_RECOVERY
from urdfkit.sim.engine.simulation_memory import GUESSES

G = 9.81
X = 3.0
"""Where things are, away from the robot [m]."""


def energy(engine):
    """Return kinetic and potential energy of all bodies [J]."""
    total = 0.0
    for body in engine.bodies.values():
        twist, mass = np.array(body.twist), body.body.mass
        total += 0.5 * mass * twist[:3] @ twist[:3] + mass * G * body.pose[2]
        total += 0.5 * twist[3:] @ np.array(body.body.inertia) @ twist[3:]
    return total


def test_a_knocked_stack_slips_and_stands_and_needs_no_matrix_of_rows(engine_of):
    engine = rover(engine_of, bodies=[cube(f"box{k}", (X, 0.0, 0.1 + 0.2 * k)) for k in range(5)], sleep=False)
    engine.step(50)
    sign = 1.0
    for _ in range(6):
        top = engine.bodies["box4"]
        top.place(top.pose, (0.02 * sign, 0.0, 0.0, 0.0, 0.0, 0.0))
        sign = -sign
        engine.step(60)
        assert engine.arrays["counts"][GUESSES] == 1
    for k in range(5):
        assert engine.bodies[f"box{k}"].pose[:3] == pytest.approx((X, 0.0, 0.1 + 0.2 * k), abs=1e-6)


def test_a_pile_that_slides_loses_energy_and_lies(engine_of):
    rng = np.random.default_rng(1)
    things = []
    for k in range(10):
        at = (X - 0.1 + 0.2 * (k % 2), -0.1 + 0.2 * (k // 2 % 2), 0.15 + 0.2 * (k // 4))
        turned = rng.normal(size=4)
        thing = cube(f"b{k}", at, side=0.12, mu=0.4) if k % 3 else ball(f"b{k}", at, radius=0.06)
        things.append(replace(thing, pose=(*at, *(turned / np.linalg.norm(turned)))))
    walls = [
        slab(f"wall{k}", (X + 0.25 * x, 0.25 * y, 0.25), (0.05 if x else 0.5, 0.05 if y else 0.5, 0.5), static=True)
        for k, (x, y) in enumerate(((1, 0), (-1, 0), (0, 1), (0, -1)))
    ]
    engine = rover(engine_of, bodies=[*walls, *things], sleep=False)
    before, most = energy(engine), 0.0
    for _ in range(1500):
        engine.step()
        after = energy(engine)
        most, before = max(most, after - before), after
    # What is taken back of penetrations lifts a little.
    assert most < 1e-3
    assert max(contact.depth for contact in engine.contacts()) < 1e-3
    assert max(np.abs(body.twist[:3]).max() for body in engine.bodies.values()) < 0.5


def test_a_ball_knocks_a_pyramid_over_and_nothing_flies_off(engine_of):
    bricks = [
        cube(f"r{row}c{column}", (X + 0.2 * column + 0.1 * row, 0.0, 0.1 + 0.2 * row))
        for row in range(3)
        for column in range(3 - row)
    ]
    shot = ball("shot", (X - 0.6, 0.0, 0.3), mass=5.0)
    engine = rover(engine_of, bodies=[*bricks, shot])
    engine.bodies["shot"].place(engine.bodies["shot"].pose, (4.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    before = energy(engine)
    for _ in range(150):
        engine.step(10)
        after = energy(engine)
        assert after < before + 1e-3
        before = after
    assert max(np.abs(np.array(body.pose[:3]) - (X, 0.0, 0.0)).max() for body in engine.bodies.values()) < 5.0
    assert engine.bodies["r0c2"].pose[0] > X + 0.41


def test_a_ball_round_a_robot_throws_nothing(engine_of):
    engine = rover(engine_of, bodies=[ball("unit_sphere", (0.0, 0.0, 0.5), radius=0.5)])
    fastest = 0.0
    for _ in range(200):
        engine.step(5)
        fastest = max(fastest, np.abs(engine.v[:3]).max(), np.abs(engine.bodies["unit_sphere"].twist[:3]).max())
    assert fastest < 1.0


@pytest.mark.parametrize("depth", [0.18e-3, 2e-3, 0.05])
def test_what_is_found_in_others_is_pushed_out_at_no_more_than_a_bounded_speed(engine_of, depth):
    wall = slab("wall", (X + 0.15, 0.0, 0.5), (0.1, 2.0, 1.0), static=True)
    pushed = [cube("in_wall", (X + depth, 0.0, 0.1)), cube("beside", (X - 0.2 + 2.0 * depth, 0.0, 0.1))]
    engine = rover(engine_of, bodies=[wall, *pushed], sleep=False)
    fastest = highest = 0.0
    for _ in range(200):
        engine.step()
        for body in engine.bodies.values():
            fastest = max(fastest, float(np.abs(body.twist[:3]).max()))
            highest = max(highest, body.pose[2])
    # The second is pushed by the first, which is pushed itself.
    assert fastest < 2.0 * FASTEST_RECOVERY + 1e-6
    assert highest < 0.1 + 1e-3
