"""What nothing holds keeps its energy and momentum; dampers and spins are those of the closed forms."""

from __future__ import annotations

import math

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.sim.engine import Surface
from urdfkit.sim.engine.bodies import Body

DT = [0.001, 0.005]


def energy(engine, gravity=(0.0, 0.0, -9.81)):
    model = engine.kinematics.model.copy()
    model.gravity.linear = np.array(gravity)
    data = model.createData()
    kinetic = pin.computeKineticEnergy(model, data, engine.q, engine.v)
    return kinetic + pin.computePotentialEnergy(model, data, engine.q)


@pytest.mark.parametrize(("dt", "most"), [(0.001, 1e-5), (0.005, 4e-2)])
def test_an_undamped_chain_keeps_its_energy(engine_of, dt, most):
    engine = engine_of("double_pendulum", floating=False, dt=dt)
    engine.reset(pin.integrate(engine.kinematics.model, engine.kinematics.neutral(), np.array([2.0, 1.0])), np.zeros(2))
    start, worst = energy(engine), 0.0
    for _ in range(100):
        engine.step(round(0.1 / dt))
        worst = max(worst, abs(energy(engine) - start))
    assert worst < most  # [J], of some 40 J that come and go


@pytest.mark.parametrize(("dt", "most"), [(0.001, 1e-9), (0.005, 1e-7)])
def test_a_free_body_spinning_about_its_middle_axis_keeps_energy_and_momentum(engine_of, dt, most):
    inertia = np.array([0.01, 0.03, 0.05])
    engine = engine_of("plate", floating=True, dt=dt, gravity=(0, 0, 0), ground=None)
    engine.reset(engine.kinematics.neutral(), np.array([0.3, 0.2, 0.1, 0.01, 5.0, 0.02]))

    def spin():
        R = pin.Quaternion(engine.q[3:7].copy()).matrix()
        return R @ (inertia * engine.v[3:]), R @ engine.v[:3]

    before, velocity = spin()
    start = energy(engine, (0, 0, 0))
    engine.step(round(20.0 / dt))
    after, now = spin()
    assert energy(engine, (0, 0, 0)) == pytest.approx(start, rel=most)
    assert after == pytest.approx(before, abs=most * np.linalg.norm(before))
    assert now == pytest.approx(velocity, abs=1e-10)
    assert engine.q[:3] == pytest.approx(20.0 * velocity, abs=1e-8)


def test_a_flying_body_moves_as_the_equations_of_trees_have_it(engine_of):
    at, tensor = (0.0, 0.0, 9.0, 0.1, -0.3, 0.2, 0.9273618495495703), np.diag([0.03, 0.05, 0.07]) + 0.004
    flying, reference = (
        Body(name, at, mass=2.0, centre=(0.1, -0.05, 0.02), inertia=tensor, weightless=weightless)
        # What has a part without gravity, however small, takes the general way.
        for name, weightless in (("flying", 0.0), ("reference", 1e-300))
    )
    engine = engine_of("plate", floating=False, bodies=[flying, reference])
    for body in engine.bodies.values():
        body.place(at, (0.3, -0.2, 4.0, 6.0, -9.0, 5.0))
    engine.step(700)
    found, expected = engine.bodies["flying"], engine.bodies["reference"]
    assert np.linalg.norm(np.subtract(found.pose[:3], at[:3])) > 0.5
    assert found.pose == pytest.approx(expected.pose, abs=1e-12)
    assert found.twist == pytest.approx(expected.twist, abs=1e-11)


@pytest.mark.parametrize("dt", DT)
def test_a_spinning_ball_comes_to_roll_as_the_closed_form_has_it(engine_of, dt):
    # Its angular momentum about a line through the contact stays: vx = (5·1 - 2·0.1·40)/7, vy = 5/7·0.3.
    engine = engine_of("light_ball", dt=dt, surfaces={"body": Surface(0.3, 0.3)})
    q = engine.kinematics.neutral()
    q[2] = 0.1
    engine.reset(q, np.array([1.0, 0.3, 0.0, 0.0, -40.0, 7.0]))
    engine.step(round(2.0 / dt))
    R = pin.Quaternion(engine.q[3:7].copy()).matrix()
    assert R @ engine.v[:3] == pytest.approx([-3.0 / 7.0, 1.5 / 7.0, 0.0], abs=1e-8)
    assert R @ engine.v[3:] == pytest.approx([-15.0 / 7.0, -30.0 / 7.0, 7.0], abs=1e-7)


@pytest.mark.parametrize("dt", [0.001, 0.005, 0.01, 0.2])
def test_a_damper_brakes_as_the_exponential(engine_of, dt):
    engine = engine_of("flywheel", floating=False, dt=dt)
    engine.reset(engine.kinematics.neutral(), np.array([5.0]))
    engine.step(round(1.0 / dt))
    assert engine.v[0] == pytest.approx(5.0 * math.exp(-1.5), rel=1e-9)


@pytest.mark.parametrize(("dt", "most"), [(0.001, 1e-4), (0.005, 2e-3)])
def test_a_chain_with_a_mimic_joint_keeps_its_energy(engine_of, dt, most):
    engine = engine_of("mimic_chain", floating=False, dt=dt)
    engine.reset(pin.integrate(engine.kinematics.model, engine.kinematics.neutral(), np.ones(2)), np.zeros(2))
    start, worst = energy(engine), 0.0
    for _ in range(30):
        engine.step(round(0.1 / dt))
        worst = max(worst, abs(energy(engine) - start))
    assert worst < most
