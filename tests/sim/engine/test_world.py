"""Several robots and bodies in one world: they meet, pile up, push each other, and leave each other alone."""

from __future__ import annotations

import math

import numpy as np
import pytest

from tests.reference_engine import ENGINES
from urdfkit.description.sdf import Plane
from urdfkit.description.urdf.robot import Box, Sphere
from urdfkit.errors import SimulationError
from urdfkit.scene import Shape
from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.bodies import Body, Member, Piece

G = 9.81
LEVEL = (0.0, 0.0, 0.0, 1.0)


def piece(geometry, mu=1.0):
    return Piece(Shape("collision", "body", "collision", geometry, np.eye(4)), Surface(mu, mu))


def cube(name, at, side=0.2, mass=1.0, mu=1.0, **options):
    inertia = np.eye(3) * mass * side**2 / 6.0
    return Body(name, (*at, *LEVEL), [piece(Box((side,) * 3), mu)], mass=mass, inertia=inertia, **options)


def ball(name, at, radius=0.1, mass=1.0, **options):
    inertia = np.eye(3) * 0.4 * mass * radius**2
    return Body(name, (*at, *LEVEL), [piece(Sphere(radius))], mass=mass, inertia=inertia, **options)


def start(engine, x=0.0, y=0.0):
    q = engine.kinematics.neutral()
    q[:3] = x, y, 0.06
    return q


def wheels(engine_of, **options):
    engine = engine_of("diff_drive", surfaces={"base": Surface(0.0, 0.0)}, **options)
    engine.reset(start(engine))
    return engine


def test_five_boxes_stand_on_each_other_without_creeping(engine_of):
    engine = wheels(engine_of, bodies=[cube(f"box{k}", (1.0, 0.0, 0.1 + 0.2 * k)) for k in range(5)])
    engine.step(60_000)
    for k in range(5):
        assert engine.bodies[f"box{k}"].pose == pytest.approx((1.0, 0.0, 0.1 + 0.2 * k, *LEVEL), abs=1e-6)
    load = sum(c.force[2] for c in engine.contacts() if (c.a, c.b) == ("box0", "box1"))
    assert load == pytest.approx(-4.0 * G, rel=1e-5)


def test_a_body_falls_onto_one_that_does_not_move(engine_of):
    table = cube("table", (2.0, 0.0, 0.5), side=0.4, static=True)
    engine = wheels(engine_of, bodies=[table, ball("ball", (2.0, 0.0, 1.0)), cube("box", (3.0, 0.0, 2.0))])
    engine.step(200)
    assert engine.bodies["box"].pose[2] == pytest.approx(2.0 - 0.5 * G * 0.04, abs=1e-9)
    engine.step(2800)
    assert engine.bodies["ball"].pose[:3] == pytest.approx((2.0, 0.0, 0.8), abs=1e-4)
    assert engine.bodies["box"].pose[2] == pytest.approx(0.1, abs=1e-4)
    assert ("ball", "table") in [(c.a, c.b) for c in engine.contacts()]


def test_the_smaller_friction_of_a_pair_holds(engine_of):
    angle = 0.3
    gravity = (G * math.sin(angle), 0.0, -G * math.cos(angle))
    floor = Body("floor", pieces=[piece(Plane())], static=True)
    speeds = {}
    for mu in (0.2, 0.5):
        bodies = [floor, cube("box", (5.0, 0.0, 0.1), mu=mu)]
        engine = engine_of("box", ground=None, gravity=gravity, bodies=bodies)
        q = engine.kinematics.neutral()
        q[:3] = 0.0, 3.0, 1.0
        engine.reset(q)
        engine.step(1000)
        speeds[mu] = engine.bodies["box"].twist[0]
    assert speeds[0.2] == pytest.approx(G * (math.sin(angle) - 0.2 * math.cos(angle)), rel=1e-3)
    assert abs(speeds[0.5]) < 1e-6


def test_a_robot_pushes_a_box(engine_of):
    engine = wheels(engine_of, bodies=[cube("box", (0.5, 0.0, 0.05), side=0.1, mass=0.2, mu=0.3)])
    engine.motor_velocity[6:], engine.motor_effort[6:] = 5.0, 5.0
    engine.step(3000)
    x = engine.bodies["box"].pose[0]
    assert 0.7 < x < 1.2
    assert engine.q[0] < x - 0.05
    assert abs(engine.bodies["box"].pose[2] - 0.05) < 1e-3


def test_momentum_passes_between_balls(engine_of):
    bodies = [ball("one", (0.0, 0.0, 3.0)), ball("two", (1.0, 0.0, 3.0), mass=2.0)]
    engine = wheels(engine_of, bodies=bodies, gravity=(0.0, 0.0, 0.0))
    engine.bodies["one"].place(bodies[0].pose, (1.5, 0.0, 0.0, 0.0, 0.0, 0.0))
    engine.step(1000)
    # Impacts are inelastic.
    assert engine.bodies["one"].twist[0] == pytest.approx(0.5, abs=1e-9)
    assert engine.bodies["two"].twist[0] == pytest.approx(0.5, abs=1e-9)


def test_robots_that_do_not_touch_drive_as_if_alone(engine_of):
    alone = engine_of("diff_drive", surfaces={"base": Surface(0.0, 0.0)})
    other = Member(alone.kinematics, alone_shapes(alone), {"base": Surface(0.0, 0.0)}, name="other")
    both = wheels(engine_of, others=[other])
    both.robots[1].put(start(alone, y=1.0))
    alone.reset(start(alone))
    for robot in (alone, *both.robots):
        robot.motor_velocity[6:], robot.motor_effort[6:] = (7.0, 9.0), 1.0
    for engine in (alone, both):
        engine.step(500)
    first, second = both.robots
    assert first.q == pytest.approx(alone.q, abs=1e-9)
    assert second.q - alone.q == pytest.approx([0.0, 1.0, *[0.0] * (len(alone.q) - 2)], abs=1e-9)


def alone_shapes(engine):
    from urdfkit.scene import scene_of

    return scene_of(engine.kinematics.robot).shapes


def test_robots_cannot_drive_through_each_other(engine_of):
    probe = engine_of("diff_drive")
    other = Member(probe.kinematics, alone_shapes(probe), {"base": Surface(0.0, 0.0)}, name="other")
    engine = wheels(engine_of, others=[other])
    engine.robots[1].put(start(engine, x=0.6))
    engine.motor_velocity[6:], engine.motor_effort[6:] = 5.0, 1.0
    engine.robots[1].motor_effort[6:] = 0.5
    engine.step(3000)
    assert engine.robots[1].q[0] - engine.q[0] > 0.27
    assert "other::base" in [c.b for c in engine.contacts()]


@pytest.mark.slow
def test_the_reference_agrees_on_a_world(engine_of):
    states = []
    for engine_type in ENGINES:
        bodies = [cube(f"box{k}", (0.35 + 0.01 * k, 0.02 * k, 0.1 + 0.2 * k)) for k in range(2)]
        engine = wheels(engine_of, bodies=[*bodies, ball("ball", (0.0, 0.0, 0.4))], engine=engine_type)
        engine.motor_velocity[6:], engine.motor_effort[6:] = 6.0, 2.0
        engine.step(150)
        states.append(np.concatenate([engine.q, engine.v, *(body.pose for body in engine.bodies.values())]))
    assert states[0] == pytest.approx(states[1], abs=1e-7)


def test_the_same_world_twice_is_the_same_to_the_last_bit(engine_of):
    states = []
    for _ in range(2):
        bodies = [cube(f"box{k}", (0.4, 0.05 * k, 0.1 + 0.21 * k)) for k in range(3)]
        engine = wheels(engine_of, bodies=bodies)
        engine.motor_velocity[6:], engine.motor_effort[6:] = 6.0, 2.0
        engine.step(1000)
        states.append(b"".join(np.array(body.pose).tobytes() for body in engine.bodies.values()))
    assert states[0] == states[1]


def test_bodies_that_cannot_be_are_refused(engine_of):
    with pytest.raises(SimulationError, match="two bodies called `box`"):
        wheels(engine_of, bodies=[cube("box", (1.0, 0.0, 0.1)), cube("box", (2.0, 0.0, 0.1))])
    with pytest.raises(SimulationError, match="body `box` cannot move: its mass is 0 kg"):
        wheels(engine_of, bodies=[cube("box", (1.0, 0.0, 0.1), mass=0.0)])
