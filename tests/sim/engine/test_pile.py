"""Heaps of many bodies: they stay in their box, lie on each other, and come to rest."""

from __future__ import annotations

from dataclasses import replace
from math import cos, sin

import numpy as np
import pytest

from tests.reference_engine import ENGINES
from tests.sim.engine.worlds import ball, can, cube, pill, rover, slab
from urdfkit.sim.engine.simulation_memory import GUESSES

G = 9.81
X = 3.0
"""Where the heaps are, away from the robot [m]."""


def box_walls():
    sides = ((0.35, 0.0, 0.1, 0.9), (-0.35, 0.0, 0.1, 0.9), (0.0, 0.35, 0.9, 0.1), (0.0, -0.35, 0.9, 0.1))
    return [slab(f"wall{k}", (X + x, y, 1.0), (a, b, 2.0), static=True) for k, (x, y, a, b) in enumerate(sides)]


def heap():
    makers = (
        lambda name, at: cube(name, at, side=0.12),
        lambda name, at: ball(name, at, radius=0.06),
        can,
        pill,
        lambda name, at: cube(name, at, side=0.08, mass=0.3),
    )
    return [
        makers[k % 5](f"b{k}", (X - 0.14 + 0.14 * (k % 3), -0.14 + 0.14 * (k // 3 % 3), 0.1 + 0.16 * (k // 9)))
        for k in range(30)
    ]


def test_thirty_bodies_dropped_in_columns_stay_in_their_box(engine_of):
    engine = rover(engine_of, bodies=[*box_walls(), *heap()], dt=0.002)
    engine.motor_effort[6:] = 1.0
    for _ in range(20):
        engine.step(500)
        places = np.array([body.pose[:3] for body in engine.bodies.values()])
        assert (np.abs(places[:, 0] - X) < 0.3).all()
        assert (np.abs(places[:, 1]) < 0.3).all()
        assert (places[:, 2] > 0.03).all()
        assert (places[:, 2] < 1.2).all()
    assert engine.t == pytest.approx(20.0)
    assert max(contact.depth for contact in engine.contacts()) < 2e-3
    # What is under and around them carries their weight.
    carried = 0.0
    for contact in engine.contacts():
        carried += contact.force[2] * ((contact.a in engine.bodies) - (contact.b in engine.bodies))
    weight = G * sum(body.body.mass for body in engine.bodies.values())
    assert carried == pytest.approx(weight, rel=0.02)


@pytest.mark.parametrize(("along", "tilt"), [(0.02, -0.3), (0.11, -0.5), (0.11, 0.1), (0.11, 0.2), (0.11, 0.3)])
def test_boxes_that_lean_on_each_other_need_no_rounds_at_rest(engine_of, along, tilt):
    yaw = 0.1
    turned = (0.0, sin(0.5 * tilt) * cos(0.5 * yaw), sin(0.5 * yaw) * cos(0.5 * tilt), cos(0.5 * tilt) * cos(0.5 * yaw))
    turned /= np.linalg.norm(turned)
    upper = replace(cube("c", (0.0, 0.0, 0.0)), pose=(X + along, 0.02, 0.35, *turned))
    engine = rover(engine_of, bodies=[cube("a", (X, 0.0, 0.1)), cube("b", (X + 0.21, 0.0, 0.1)), upper], sleep=False)
    engine.step(2500)
    assert np.abs(engine.v).max() < 1e-6
    before = engine.iterated
    engine.step(100)
    assert engine.iterated == before


def test_a_wall_of_bricks_is_solved_by_blocks_and_stands(engine_of):
    bricks = [
        cube(f"r{row}c{column}", (X + 0.2 * column + 0.1 * (row % 2), 0.0, 0.1 + 0.2 * row))
        for row in range(4)
        for column in range(4 - row % 2)
    ]
    engine = rover(engine_of, bodies=bricks, sleep=False)
    engine.step(1000)
    assert 0 < engine.arrays["counts"][GUESSES] < 3
    assert engine.iterated == 0
    for brick in bricks:
        assert engine.bodies[brick.name].pose == pytest.approx(brick.pose, abs=1e-6)
    on_ground = sum(c.force[2] for c in engine.contacts() if c.b == "ground_plane" and c.a in engine.bodies)
    assert on_ground == pytest.approx(len(bricks) * G, rel=1e-6)


@pytest.mark.slow
def test_blocks_and_the_matrix_of_rows_agree(engine_of):
    states = []
    for engine_type in ENGINES:
        bricks = [
            cube(f"r{row}c{column}", (X + 0.2 * column + 0.11 * (row % 2), 0.003 * column, 0.1 + 0.2 * row))
            for row in range(2)
            for column in range(3 - row)
        ]
        engine = rover(engine_of, bodies=bricks, sleep=False, engine=engine_type)
        engine.step(20)
        twists = [body.twist for body in engine.bodies.values()]
        states.append((np.array([body.pose for body in engine.bodies.values()]), np.array(twists)))
    assert states[0][0] == pytest.approx(states[1][0], abs=1e-11)
    assert states[0][1] == pytest.approx(states[1][1], abs=1e-9)


def test_a_table_on_many_feet_carries_what_stands_on_it(engine_of):
    from urdfkit.description.urdf.robot import Box
    from urdfkit.scene import Shape
    from urdfkit.sim.engine.bodies import Body, Piece

    def part(size, at):
        place = np.eye(4)
        place[:3, 3] = at
        return Piece(Shape("collision", "table", "collision", Box(size), place))

    feet = [part((0.05, 0.05, 0.7), (x, y, 0.35)) for x in (-0.5, 0.5) for y in (-0.3, 0.3)]
    inertia = np.diag([1.0, 1.5, 2.0])
    table = Body(
        "table",
        (X, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0),
        [part((1.1, 0.7, 0.04), (0.0, 0.0, 0.72)), *feet],
        mass=20.0,
        centre=(0.0, 0.0, 0.6),
        inertia=inertia,
    )
    things = [cube(f"cup{k}", (X - 0.4 + 0.2 * k, 0.1, 0.79), side=0.1) for k in range(5)]
    engine = rover(engine_of, bodies=[table, *things], sleep=False)
    engine.step(1500)
    feet_carry = sum(c.force[2] for c in engine.contacts() if (c.a, c.b) == ("table", "ground_plane"))
    assert feet_carry == pytest.approx(25.0 * G, rel=1e-6)
    assert engine.bodies["table"].pose == pytest.approx(table.pose, abs=1e-5)
    assert engine.iterated == 0
