"""Friction with two coefficients: the ellipse, its direction, and surfaces that meet."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from tests.reference_engine import ENGINES
from urdfkit.description.urdf.robot import Box
from urdfkit.scene import Shape
from urdfkit.sim.engine import Body, Piece, Surface

G = 9.81


def sliding(engine_of, surface, angle, speed=2.0, yaw=0.0, **options):
    engine = engine_of("box", surfaces={"body": surface}, **options)
    q = engine.kinematics.neutral()
    q[2] = 0.05
    q[5], q[6] = math.sin(yaw / 2), math.cos(yaw / 2)
    v = np.zeros(6)
    v[:2] = speed * math.cos(angle - yaw), speed * math.sin(angle - yaw)
    engine.reset(q, v)
    return engine


def world_velocity(engine):
    yaw = 2 * math.atan2(engine.q[5], engine.q[6])
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array([c * engine.v[0] - s * engine.v[1], s * engine.v[0] + c * engine.v[1]])


def ellipse(velocity, mu1, mu2):
    """Return the deceleration of most dissipation: friction on the ellipse, against the slip [m/s^2]."""
    scaled = np.array([mu1, mu2]) * velocity
    return -G * np.array([mu1, mu2]) * scaled / np.linalg.norm(scaled)


@pytest.mark.parametrize("yaw", [0.0, 0.7])
def test_a_box_that_slides_at_45_degrees_obeys_the_ellipse(engine_of, yaw):
    mu1, mu2 = 0.2, 0.8
    surface = Surface(mu1, mu2, (1.0, 0.0, 0.0))
    engine = sliding(engine_of, surface, yaw + math.pi / 4, yaw=yaw)
    turn = np.array([[math.cos(yaw), math.sin(yaw)], [-math.sin(yaw), math.cos(yaw)]])
    engine.step(5)
    velocities = [turn @ world_velocity(engine)]
    for _ in range(100):
        engine.step()
        velocities.append(turn @ world_velocity(engine))
    for before, after in pairwise(velocities):
        assert (after - before) / engine.dt == pytest.approx(ellipse(after, mu1, mu2), abs=2e-3)
    assert engine.iterated == 0
    force = sum((np.array(contact.force) for contact in engine.contacts()), np.zeros(3))
    assert turn @ force[:2] == pytest.approx(2.0 * ellipse(velocities[-1], mu1, mu2), abs=4e-3)


def test_without_a_direction_the_axes_are_the_worlds(engine_of):
    engine = sliding(engine_of, Surface(0.0, 0.5), 0.0, yaw=0.4)
    engine.step(300)
    assert world_velocity(engine) == pytest.approx([2.0, 0.0], abs=1e-9)
    engine = sliding(engine_of, Surface(0.0, 0.5), math.pi / 2, speed=1.0)
    engine.step(300)
    assert world_velocity(engine) == pytest.approx([0.0, 0.0], abs=1e-9)


def test_a_caster_without_friction_glides(engine_of):
    engine = sliding(engine_of, Surface(0.0, 0.0), 0.3, speed=1.0)
    engine.step(500)
    assert np.linalg.norm(world_velocity(engine)) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize("owner", ["box", "table"])
def test_the_direction_of_the_smaller_coefficient_counts(engine_of, owner):
    # One of them is slippery along y; the other rubs alike everywhere and has another direction.
    slick, rough = Surface(0.05, 0.6, (0.0, 1.0, 0.0)), Surface(0.9, 0.9, (1.0, 0.0, 0.0))
    table = Piece(
        Shape("top", "table", "collision", Box((40.0, 40.0, 1.0)), np.eye(4)), rough if owner == "box" else slick
    )
    body = Body("table", (0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 1.0), (table,), static=True)
    engine = sliding(engine_of, slick if owner == "box" else rough, math.pi / 2, ground=None, bodies=[body])
    engine.step(200)
    assert world_velocity(engine) == pytest.approx([0.0, 2.0 - 0.05 * G * 0.2], abs=1e-3)


@pytest.mark.slow
def test_compiled_and_reference_agree(engine_of):
    states = []
    for engine_type in ENGINES:
        surface = Surface(0.2, 0.8, (1.0, 1.0, 0.0))
        engine = sliding(engine_of, surface, 0.4, yaw=0.3, engine=engine_type)
        engine.step(60)
        states.append(np.concatenate([engine.q, engine.v]))
    assert states[0] == pytest.approx(states[1], abs=1e-9)
