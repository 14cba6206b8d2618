"""The compiled kernel and the reference engine do the same."""

from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest

from tests.reference_engine import ENGINES
from urdfkit.sim.engine import Surface

pytestmark = pytest.mark.slow  # in a fresh checkout: kernels of the tests are compiled first

HEIGHTS = {"diff_drive": 0.06, "box": 0.051, "can": 0.16, "ball": 0.1, "capsule": 0.2}


def pair(engine_of, model, **options):
    return [engine_of(model, engine=engine, **options) for engine in ENGINES]


def state(engine):
    return np.concatenate([engine.q, engine.v])


@pytest.mark.parametrize("model", [*HEIGHTS, "arm", "double_pendulum"])
def test_single_steps_agree_from_random_states(engine_of, model):
    engines = pair(engine_of, model, gravity=(0.5, 0.3, -9.81), surfaces={"body": Surface(0.4, 0.4)})
    random = np.random.default_rng(3)
    pin_model = engines[0].kinematics.model
    for _ in range(100):
        q = pin.integrate(pin_model, pin.neutral(pin_model), 0.3 * random.normal(size=pin_model.nv))
        if model in HEIGHTS:
            q[2] = HEIGHTS[model] + abs(0.02 * random.normal())
        v = random.normal(size=pin_model.nv)
        efforts = random.normal(size=pin_model.nv)
        for engine in engines:
            engine.reset(q, v)
            engine.applied[:] = efforts
            engine.step()
        assert state(engines[0]) == pytest.approx(state(engines[1]), abs=1e-9)


@pytest.mark.parametrize("model", ["diff_drive", "box", "can", "arm"])
def test_trajectories_agree(engine_of, model):
    states, forces = [], []
    for engine in pair(engine_of, model, surfaces={"base": Surface(0.0, 0.0)}):
        q = engine.kinematics.neutral()
        v = np.zeros(engine.kinematics.model.nv)
        if model in HEIGHTS:
            q[2] = HEIGHTS[model]
            v[0] = 0.5
        if model == "diff_drive":
            v[:] = 0.0
            engine.motor_velocity[6:], engine.motor_effort[6:] = (3.0, 5.0), 0.3
        if model == "arm":
            engine.kp[:], engine.kd[:], engine.position_target[:] = 2e3, 50.0, 0.4
            engine.servo_effort[:] = 50.0
        engine.reset(q, v)
        engine.step(300)
        states.append(np.concatenate([state(engine), engine.effort, engine.tau]))
        forces.append([(c.a, c.b, c.depth, *c.position, *c.normal) for c in engine.contacts()])
    assert states[0] == pytest.approx(states[1], abs=1e-8)
    assert len(forces[0]) == len(forces[1])
    for one, other in zip(*forces, strict=True):
        assert one[:2] == other[:2]
        assert one[2:] == pytest.approx(other[2:], abs=1e-9)


@pytest.mark.parametrize("antiwindup", [0.0, 1.0])
def test_integral_gains_agree(engine_of, antiwindup):
    states = []
    for engine in pair(engine_of, "arm"):
        engine.kp[:], engine.kd[:], engine.position_target[:] = 80.0, 8.0, 0.3
        engine.kp[6], engine.velocity_target[6] = 0.0, 0.2
        engine.ki[:], engine.i_min[:], engine.i_max[:] = 60.0, -2.0, 3.0
        engine.antiwindup[:], engine.feedforward[2] = antiwindup, 0.4
        engine.step(400)
        states.append(np.concatenate([state(engine), engine.effort, engine.integral]))
    assert states[0] == pytest.approx(states[1], abs=1e-8)


def test_bodies_fall_alike_beside_a_robot_without_joints(engine_of):
    from urdfkit.description.urdf.robot import Sphere
    from urdfkit.scene import Shape
    from urdfkit.sim.engine.bodies import Body, Piece

    ball = Piece(Shape("collision", "ball", "collision", Sphere(0.1), np.eye(4)), Surface(1.0, 1.0))
    body = Body("ball", (2.0, 0.0, 0.5, 0.0, 0.0, 0.0, 1.0), [ball], mass=1.0, inertia=0.004 * np.eye(3))
    engines = pair(engine_of, '<robot name="n"><link name="base"/></robot>', bodies=[body], sleep=False)
    for engine in engines:
        engine.step(400)
    poses = [engine.bodies["ball"].pose for engine in engines]
    assert poses[0] == pytest.approx(poses[1], abs=1e-9)
    assert poses[0][2] == pytest.approx(0.1, abs=1e-6)
