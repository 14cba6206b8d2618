"""What moves as textbooks say: closed forms for falling, sliding, rolling, swinging, sticking and driving."""

from __future__ import annotations

import math

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.errors import SimulationError
from urdfkit.sim.engine import Ground, Surface

G = 9.81


def tilted(angle: float) -> tuple[float, float, float]:
    """Gravity of an incline that falls towards +x."""
    return (G * math.sin(angle), 0.0, -G * math.cos(angle))


def at_height(engine, z, v=None):
    q = engine.kinematics.neutral()
    q[2] = z
    engine.reset(q, v)


def test_free_fall_is_exact(engine_of):
    engine = engine_of("box")
    at_height(engine, 100.0, np.array([1.0, 2.0, 3.0, 0.0, 0.0, 0.0]))
    engine.step(2000)
    assert engine.q[:3] == pytest.approx([2.0, 4.0, 100.0 + 6.0 - 0.5 * G * 4.0], abs=1e-9)
    assert engine.v[:3] == pytest.approx([1.0, 2.0, 3.0 - 2.0 * G], abs=1e-10)


def test_a_spinning_body_keeps_energy_and_angular_momentum(engine_of):
    engine = engine_of("box", gravity=(0.0, 0.0, 0.0), ground=None)
    engine.reset(None, np.array([0.1, 0.2, 0.0, 3.0, 0.05, 2.0]))

    def momentum():
        R = pin.Quaternion(engine.q[3:7]).matrix()
        return R @ engine.mass_matrix()[3:, 3:] @ engine.v[3:]

    energy, before = engine.energy()[0], momentum()
    engine.step(10000)
    assert engine.energy()[0] == pytest.approx(energy, rel=1e-4)
    assert momentum() == pytest.approx(before, rel=1e-3, abs=1e-4)


def test_the_parts_of_a_free_robot_push_nothing_but_each_other(engine_of):
    engine = engine_of("diff_drive", gravity=(0.0, 0.0, 0.0), ground=None)
    model, data = engine.kinematics.model, engine.kinematics.data
    engine.motor_velocity[6:] = 30.0, -10.0
    engine.motor_effort[6:] = 0.5
    engine.step(1000)
    assert engine.v[6:] == pytest.approx([30.0, -10.0])
    pin.computeCentroidalMomentum(model, data, engine.q, engine.v)
    assert data.hg.vector == pytest.approx(np.zeros(6), abs=1e-5)


def test_pendulum_period(engine_of):
    engine = engine_of("pendulum")
    angle = 0.5
    engine.reset(engine.kinematics.configuration({"hinge": angle}))
    crossings, before = [], angle
    for k in range(10000):
        engine.step()
        now = engine.positions[0]
        if before > 0.0 >= now:
            crossings.append((k + before / (before - now)) * engine.dt)
        before = now
    # T = 4·sqrt(l/g)·K(sin(a/2)), by the arithmetic-geometric mean.
    a, b = 1.0, math.cos(angle / 2)
    for _ in range(6):
        a, b = (a + b) / 2, math.sqrt(a * b)
    period = 2.0 * math.pi * math.sqrt(1.0 / G) / a
    assert np.diff(crossings).mean() == pytest.approx(period, rel=1e-5)


def test_double_pendulum_keeps_its_energy(engine_of):
    engine = engine_of("double_pendulum")
    engine.reset(engine.kinematics.configuration({"shoulder": 2.0, "elbow": 1.0}))
    start, worst = sum(engine.energy()), 0.0
    for _ in range(500):
        engine.step(20)
        worst = max(worst, abs(sum(engine.energy()) - start))
    assert worst < 2e-2  # of some 30 J that swing


@pytest.mark.parametrize("model", ["box", "can"])
@pytest.mark.parametrize("direction", [0.0, 0.6, math.pi / 2])
def test_a_sliding_body_stops_where_it_should(engine_of, model, direction):
    mu, speed = 0.4, 1.5
    engine = engine_of(model, surfaces={"body": Surface(mu, mu)})
    at_height(engine, {"box": 0.05, "can": 0.15}[model])
    q = engine.q
    engine.reset(q, np.array([speed * math.cos(direction), speed * math.sin(direction), 0.0, 0.0, 0.0, 0.0]))
    engine.step(1500)
    way = engine.q[:2] - q[:2]
    assert np.hypot(*way) == pytest.approx(speed**2 / (2 * mu * G), rel=0.01)
    assert math.atan2(way[1], way[0]) == pytest.approx(direction, abs=1e-6)
    assert np.abs(engine.v).max() < 1e-9


@pytest.mark.parametrize("model", ["box", "can"])
def test_a_body_on_an_incline_sticks_below_its_angle_of_friction_and_slides_above(engine_of, model):
    mu = 0.3
    height = {"box": 0.05, "can": 0.15}[model]
    for share in (0.5, 0.98):
        engine = engine_of(model, gravity=tilted(share * math.atan(mu)), surfaces={"body": Surface(mu, mu)})
        at_height(engine, height)
        engine.step(2000)
        assert np.abs(engine.q[:3] - [0.0, 0.0, height]).max() < 1e-7
    angle = 1.02 * math.atan(mu)
    engine = engine_of(model, gravity=tilted(angle), surfaces={"body": Surface(mu, mu)})
    at_height(engine, height)
    engine.step(2000)
    assert engine.v[0] == pytest.approx(2.0 * G * (math.sin(angle) - mu * math.cos(angle)), rel=1e-3)


@pytest.mark.parametrize(
    ("model", "turn", "factor"), [("ball", None, 5.0 / 7.0), ("can", [0.5**0.5, 0, 0, 0.5**0.5], 2.0 / 3.0)]
)
def test_a_rolling_body_accelerates_as_it_should(engine_of, model, turn, factor):
    angle = 0.1
    engine = engine_of(model, gravity=tilted(angle))
    q = engine.kinematics.neutral()
    q[2] = 0.1
    if turn is not None:
        q[3:7] = turn
    engine.reset(q)
    engine.step(1000)
    assert (engine.q - q)[0] == pytest.approx(0.5 * factor * G * math.sin(angle), rel=2e-3)


@pytest.mark.parametrize(("model", "height", "points"), [("box", 0.05, 4), ("can", 0.15, 3), ("ball", 0.1, 1)])
def test_a_body_at_rest_stays_on_enough_contacts(engine_of, model, height, points):
    engine = engine_of(model)
    at_height(engine, height)
    engine.step(3000)
    found = engine.contacts()
    assert len(found) >= points
    assert sum(contact.force[2] for contact in found) == pytest.approx(2.0 * G, rel=1e-6)
    assert np.abs(engine.q[:3] - [0.0, 0.0, height]).max() < 1e-12


@pytest.mark.parametrize(("model", "height"), [("box", 0.5), ("can", 0.5), ("ball", 0.3), ("capsule", 0.6)])
def test_a_dropped_body_comes_to_rest(engine_of, model, height):
    engine = engine_of(model)
    q = engine.kinematics.neutral()
    q[2] = height
    q[3:7] = pin.Quaternion(pin.rpy.rpyToMatrix(0.3, 0.2, 0.1)).coeffs()
    engine.reset(q)
    for _ in range(100):
        engine.step(50)
        mu = 1.0
        for contact in engine.contacts():
            assert contact.depth < 5e-3
            x, y, z = contact.force
            assert math.hypot(x, y) <= mu * z * (1.0 + 1e-6) + 1e-9
    if model != "capsule":
        assert np.abs(engine.v).max() < (1e-6 if model == "box" else 2.0)
    assert 0.0 < engine.q[2] < 0.2


def test_a_parked_robot_stays_where_it_is(engine_of):
    engine = engine_of("diff_drive", surfaces={"base": Surface(0.0, 0.0)})
    at_height(engine, 0.06)
    engine.motor_effort[6:] = 10.0
    engine.step(100_000)
    assert np.abs(engine.q - [0, 0, 0.06, 0, 0, 0, 1, 1, 0, 1, 0]).max() < 1e-9
    assert engine.iterated == 0


def test_a_robot_parked_on_a_slope_with_its_brakes_on_stays_where_it_is(engine_of):
    engine = engine_of("diff_drive", surfaces={"base": Surface(0.0, 0.0)}, gravity=tilted(0.15))
    at_height(engine, 0.06)
    engine.motor_effort[6:] = 10.0
    engine.step(100)
    start = engine.q
    engine.step(100_000)
    assert np.abs(engine.q - start).max() < 1e-9


def test_motor_spins_a_wheel_up_at_its_effort(engine_of):
    engine = engine_of("diff_drive", ground=None, gravity=(0.0, 0.0, 0.0), floating=False)
    engine.motor_velocity[0], engine.motor_effort[0] = 20.0, 0.045
    engine.step(100)
    assert engine.v[0] == pytest.approx(0.1 * 0.045 / 0.0009, rel=1e-9)
    assert engine.effort[0] == pytest.approx(0.045)
    engine.step(400)
    assert engine.v[0] == pytest.approx(20.0, rel=1e-7)
    assert engine.effort[0] == pytest.approx(0.0, abs=1e-6)
    assert engine.v[1] == 0.0


def drive(engine, v, w, seconds, ramp):
    """Drive with ramped commands; return where a unicycle with the same ramp gets (path against angle is a line)."""
    engine.motor_effort[6:] = 50.0
    for k in range(round(seconds / engine.dt)):
        share = min(1.0, (k + 1) * engine.dt / ramp)
        engine.motor_velocity[6:] = share * (v - 0.15 * w) / 0.06, share * (v + 0.15 * w) / 0.06
        engine.step()
    path, turn = v * (seconds - 0.5 * ramp), w * (seconds - 0.5 * ramp)
    if not turn:
        return path, 0.0, 0.0
    return path / turn * math.sin(turn), path / turn * (1.0 - math.cos(turn)), turn


@pytest.mark.parametrize(("dt", "tolerance"), [(0.001, 1e-6), (0.005, 1e-5)])
@pytest.mark.parametrize(("v", "w"), [(0.5, 0.5), (-0.3, 0.8), (0.0, 1.0), (0.8, 0.0)])
@pytest.mark.parametrize("far", [0.0, 1e4])
def test_diff_drive_follows_the_ideal_unicycle(engine_of, dt, tolerance, v, w, far):
    engine = engine_of("diff_drive", surfaces={"base": Surface(0.0, 0.0)}, dt=dt)
    q = engine.kinematics.neutral()
    q[0], q[2] = far, 0.06
    engine.reset(q)
    x, y, yaw = drive(engine, v, w, 10.0, 0.5)
    assert engine.q[0] - far == pytest.approx(x, abs=tolerance)
    assert engine.q[1] == pytest.approx(y, abs=tolerance)
    turned = 2.0 * math.atan2(engine.q[5], engine.q[6])
    assert math.remainder(turned - yaw, 2 * math.pi) == pytest.approx(0.0, abs=tolerance)
    assert abs(engine.q[2] - 0.06) < 1e-6


def test_joint_limits_hold(engine_of):
    engine = engine_of("arm")
    engine.reset(engine.kinematics.configuration({"j1": 0.5, "j3": 0.5}))
    engine.kd[:] = 0.5
    for _ in range(300):
        engine.step(10)
        assert np.abs(engine.positions).max() < 2.5 + 1e-4
    assert np.abs(engine.positions).max() > 2.4


def test_dry_friction_holds_a_joint_still(engine_of):
    engine = engine_of("pendulum")
    engine.arrays["friction"][0] = 6.0
    engine.reset(engine.kinematics.configuration({"hinge": 0.6}))
    engine.step(2000)
    assert engine.positions[0] == pytest.approx(0.6, abs=1e-9)
    engine.reset(engine.kinematics.configuration({"hinge": 0.8}))
    engine.step(50)
    # Slips: g·sin(a) - friction.
    assert engine.v[0] == pytest.approx(-0.05 * (G * math.sin(0.8) - 6.0), rel=5e-3)


def test_position_servo_holds_a_pose_and_honours_its_effort(engine_of):
    engine = engine_of("arm")
    target = np.array([0.3, 0.8, -0.4, 1.0, 0.2, -0.7, 0.5])
    engine.kp[:], engine.kd[:] = 3e3, 100.0
    engine.position_target[:] = target
    engine.servo_effort[:] = 80.0
    for _ in range(300):
        engine.step(10)
        assert np.abs(engine.effort).max() <= 80.0
    # A spring sags by what it carries.
    assert 3e3 * (target - engine.positions) == pytest.approx(engine.bias_forces(), rel=1e-6, abs=1e-6)
    assert engine.effort == pytest.approx(engine.bias_forces(), rel=1e-6, abs=1e-6)
    assert np.abs(engine.v).max() < 1e-6


def test_same_inputs_same_bytes(engine_of):
    def run():
        engine = engine_of("can")
        at_height(engine, 0.4, np.array([0.3, 0.2, 0.0, 2.0, 1.0, 3.0]))
        for _ in range(20):
            engine.step(100)
        return engine.q.tobytes() + engine.v.tobytes()

    assert run() == run()


def test_steps_in_one_call_equal_single_steps(engine_of):
    states = []
    for n in (1, 50):
        engine = engine_of("box")
        at_height(engine, 0.2, np.array([0.3, 0.2, 0.0, 2.0, 1.0, 3.0]))
        for _ in range(1000 // n):
            engine.step(n)
        states.append(engine.q)
    assert np.array_equal(*states)


def test_divergence_names_the_joint_and_the_time(engine_of):
    engine = engine_of("arm")
    engine.applied[3] = math.inf
    with pytest.raises(SimulationError, match=r"diverged at t = 0.001 s: joint `j\d`"):
        engine.step(5)


def test_a_world_without_ground_has_no_contacts(engine_of):
    engine = engine_of("box", ground=None)
    at_height(engine, 0.05)
    engine.step(100)
    assert engine.contacts() == ()
    assert engine.v[2] == pytest.approx(-0.1 * G)


def test_the_smaller_friction_counts(engine_of):
    engine = engine_of("box", ground=Ground(mu=0.2), surfaces={"body": Surface(0.9, 0.8)})
    at_height(engine, 0.05, np.array([1.0, 0, 0, 0, 0, 0]))
    engine.step(1000)
    assert engine.q[0] == pytest.approx(1.0 / (2 * 0.2 * G), rel=0.01)
