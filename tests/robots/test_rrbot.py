"""RRBot: a damped double pendulum that hangs, or is held by its position controllers as firmly as their gains allow."""

import math

import numpy as np
import pinocchio
import pytest

from urdfkit.description import load
from urdfkit.description.xacro.expand import expand
from urdfkit.messages import FLOAT, from_fields
from urdfkit.resources import find_model
from urdfkit.sim import Simulator, Spawn

BAR, WIDTH, MASS = 1.0, 0.1, 1.0


@pytest.fixture(scope="module")
def robot():
    return load(find_model(["rrbot"]).path)


def let_go(robot, **joints):
    """Start with the bars at angles [rad], without anybody to hold them."""
    simulator = Simulator(robot, spawn=Spawn(z=0.0, joints=joints), note=lambda _: None)
    simulator.controllers.stop("joint1_position_controller", "joint2_position_controller")
    return simulator


def energy(simulator):
    return sum(simulator.state.energy)


def test_links_and_joints(robot):
    assert [link.name for link in robot.roots()] == ["world"]
    assert {joint.name for joint in robot.joints if joint.is_movable} == {"joint1", "joint2"}
    for joint in ("joint1", "joint2"):
        assert robot.joint_by_name[joint].axis == (0, 1, 0)
        assert robot.joint_by_name[joint].dynamics.damping == 0.7


def test_bars_have_the_inertia_of_bars(robot):
    across = MASS * (BAR**2 + WIDTH**2) / 12
    for link in ("link2", "link3"):
        i = robot.link_by_name[link].inertial.inertia
        np.testing.assert_allclose([i.ixx, i.iyy, i.izz], [across, across, MASS * WIDTH**2 / 6], rtol=1e-12)


def test_every_joint_has_a_motor(robot):
    assert [t.joints[0].name for t in robot.transmissions] == ["joint1", "joint2"]


class Pendulum:
    """Pinocchio's word on the same arm about the pose in which it hangs."""

    def __init__(self):
        self.model = pinocchio.buildModelFromXML(expand(find_model(["rrbot"]).path).xml)
        self.data = self.model.createData()
        down = np.array([-1.0, 0.0, 1.0, 0.0])  # cos and sin of π and of 0
        self.rest = np.zeros(2)  # the camera on one side pulls the bars a little out of the plumb
        self.down = down
        for _ in range(20):
            self.rest = self.rest - np.linalg.solve(self.stiffness(), self.gravity(np.zeros(2)))
        mass = pinocchio.crba(self.model, self.data, pinocchio.integrate(self.model, down, self.rest)).copy()
        self.mass = np.triu(mass) + np.triu(mass, 1).T

    def gravity(self, dq):
        q = pinocchio.integrate(self.model, self.down, self.rest + dq)
        return pinocchio.computeGeneralizedGravity(self.model, self.data, q).copy()

    def stiffness(self, step=1e-5):
        return np.column_stack([(self.gravity(step * e) - self.gravity(-step * e)) / (2 * step) for e in np.eye(2)])


@pytest.fixture(scope="module")
def pendulum():
    return Pendulum()


def angles(simulator):
    """Return how far the arm is from hanging straight down [rad]."""
    return np.array([math.remainder(simulator.state.position("joint1") - math.pi, 2 * math.pi),
                     math.remainder(simulator.state.position("joint2"), 2 * math.pi)])  # fmt: skip


def test_it_falls_over_and_hangs(robot, pendulum):
    simulator = let_go(robot, joint1=0.05)
    before = energy(simulator)
    for _ in range(140):
        simulator.run(0.5)
        assert energy(simulator) <= before + 1e-6
        before = energy(simulator)
    np.testing.assert_allclose(angles(simulator), pendulum.rest, atol=1e-3)


def test_a_small_swing_is_that_of_a_double_pendulum(robot, pendulum):
    """About hanging, M·q̈ + D·q̇ + K·q = 0: the solution of that, next to ours."""
    inverse = np.linalg.inv(pendulum.mass)
    system = np.block([[np.zeros((2, 2)), np.eye(2)], [-inverse @ pendulum.stiffness(), -inverse * 0.7]])
    rates, shapes = np.linalg.eig(system)
    start = np.array([0.01, -0.005, 0.0, 0.0])
    at = pendulum.rest + start[:2]
    simulator = let_go(robot, joint1=math.pi + at[0], joint2=at[1])
    for _ in range(20):
        simulator.run(0.25)
        ideal = (shapes @ (np.exp(rates * simulator.t) * np.linalg.solve(shapes, start.astype(complex)))).real
        np.testing.assert_allclose(angles(simulator) - pendulum.rest, ideal[:2], atol=2e-5)


def test_its_controllers_hold_it_as_firmly_as_their_gains(robot, pendulum):
    simulator = Simulator(robot, note=lambda _: None)
    command = from_fields(FLOAT, {"data": 1.5})
    simulator.bus.publish("/rrbot/joint1_position_controller/command", FLOAT, command)
    simulator.run(10.0)
    q = np.array([simulator.state.position(joint) for joint in ("joint1", "joint2")])
    configuration = np.array([math.cos(q[0]), math.sin(q[0]), math.cos(q[1]), math.sin(q[1])])
    pull = pinocchio.computeGeneralizedGravity(pendulum.model, pendulum.data, configuration)
    np.testing.assert_allclose(100.0 * (np.array([1.5, 0.0]) - q), pull, atol=1e-3)  # the I is clamped to zero
    assert 0.15 < q[0] - 1.5 < 0.2
