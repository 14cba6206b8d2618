"""Position targets of joints with limits of acceleration, against the trapezoidal velocity profile."""

from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest

from urdfkit.sim import Simulator
from urdfkit.sim.engine.simulation_memory import FOUND_ROWS

ROBOT = """<robot name="arm" version="1.2"><link name="base"/>
  <link name="arm"><inertial><mass value="1"/>
    <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="turn" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
    <limit velocity="2" acceleration="4" deceleration="8"/></joint></robot>"""
DT, PERIOD = 0.001, 0.01


def _arm(folder: Path, text: str = ROBOT) -> Simulator:
    path = folder / "arm.urdf"
    path.write_text(text)
    return Simulator(path, fixed_base=True, dt=DT)


def _velocities(simulator: Simulator, seconds: float) -> np.ndarray:
    found = []
    for _ in range(round(seconds / PERIOD)):
        simulator.run(PERIOD)
        found.append(simulator.state.velocity("turn"))
    return np.array(found)


def test_the_joint_follows_the_trapezoidal_profile(tmp_path: Path) -> None:
    simulator = _arm(tmp_path)
    simulator.motors.hold("turn", pi)
    speeds = _velocities(simulator, 4.0)
    assert speeds.max() == pytest.approx(2.0, abs=1e-9)
    changes = np.diff(np.concatenate(([0.0], speeds))) / PERIOD
    assert changes.max() == pytest.approx(4.0, rel=1e-6)
    assert -8.0 * (1 + 1e-6) <= changes.min() < -7.5
    # 0.5 s to speed up over 0.5 rad, 0.25 s to slow down over 0.25 rad, and the rest at 2 rad/s
    moving = np.flatnonzero(speeds > 0.4)[-1] * PERIOD
    assert moving == pytest.approx(0.75 + (pi - 0.75) / 2.0 - 0.05, abs=0.03)
    assert simulator.state.position("turn") == pytest.approx(pi, abs=1e-4)


def test_a_target_behind_a_moving_joint_is_reached_within_the_limits(tmp_path: Path) -> None:
    simulator = _arm(tmp_path)
    simulator.motors.hold("turn", pi)
    before = _velocities(simulator, 1.0)
    simulator.motors.hold("turn", -1.0)
    speeds = np.concatenate((before[-1:], _velocities(simulator, 4.0)))
    changes = np.diff(speeds) / PERIOD
    assert np.abs(changes).max() <= 8.0 * (1 + 1e-6)
    assert changes[speeds[1:] < -0.05].min() >= -4.0 * (1 + 1e-6)
    assert simulator.state.position("turn") == pytest.approx(-1.0, abs=1e-4)


def test_without_limits_of_acceleration_the_speed_is_reached_at_once(tmp_path: Path) -> None:
    simulator = _arm(
        tmp_path, ROBOT.replace('version="1.2"', 'version="1.0"').replace("<limit ", '<limit effort="99" ')
    )
    simulator.motors.hold("turn", pi)
    assert _velocities(simulator, 0.05)[-1] == pytest.approx(2.0, abs=1e-6)


CHAIN = """<robot name="chain"><link name="base"/>{links}</robot>"""
LINK = """<link name="link{k}"><inertial><origin xyz="0.01 0.02 0.1"/><mass value="1"/>
    <inertia ixx="0.004" iyy="0.0044" izz="0.001" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="joint{k}" type="revolute"><parent link="{parent}"/><child link="link{k}"/><origin xyz="0 0 0.2"/>
    <axis xyz="{axis}"/><dynamics friction="{friction}"/>
    <limit lower="-2.9" upper="2.9" effort="{effort}" velocity="1.5"/></joint>"""
POSE = (0.3, 0.8, -0.4, 1.0, 0.2)


def _chain(folder: Path, *, effort: float, friction: float = 0.0) -> Simulator:
    """Return five links about z and y in turn, with position goals."""
    parents = ("base", *(f"link{k}" for k in range(len(POSE))))
    links = "".join(
        LINK.format(k=k, parent=parents[k], axis="0 1 0" if k % 2 else "0 0 1", effort=effort, friction=friction)
        for k in range(len(POSE))
    )
    path = folder / f"chain{effort}_{friction}.urdf"
    path.write_text(CHAIN.format(links=links))
    simulator = Simulator(path, fixed_base=True, dt=DT)
    for k, goal in enumerate(POSE):
        simulator.motors.hold(f"joint{k}", goal)
    return simulator


def test_joints_rest_exactly_at_their_goals_and_carry_their_weight_without_rows(tmp_path: Path) -> None:
    simulator = _chain(tmp_path, effort=200)
    engine = simulator.world.builder.engine
    simulator.run(0.3)
    assert simulator.state.velocity("joint3") == pytest.approx(1.5, abs=1e-11)
    simulator.run(4.7)
    assert engine.arrays["counts"][FOUND_ROWS] == 0
    assert np.array([simulator.state.position(f"joint{k}") for k in range(5)]) == pytest.approx(POSE, abs=1e-11)
    assert np.abs(simulator.state.v).max() < 1e-12
    assert engine.effort == pytest.approx(engine.bias_forces(), abs=1e-9)
    assert np.abs(engine.effort).max() > 5.0


def test_overloaded_motors_move_as_rows_of_the_solver_do(tmp_path: Path) -> None:
    # Dry friction, however small, makes a motor a row of the solver.
    weak, rows = _chain(tmp_path, effort=9), _chain(tmp_path, effort=9, friction=1e-13)
    limited = 0
    for _ in range(200):
        weak.run(PERIOD)
        rows.run(PERIOD)
        assert weak.state.v == pytest.approx(rows.state.v, abs=1e-6)
        assert np.abs(weak.state.tau).max() <= 9 * (1 + 1e-9)
        limited += np.abs(weak.state.tau).max() > 8.99
    assert 20 < limited < 180


def test_a_goal_survives_a_change_of_the_world(tmp_path: Path) -> None:
    simulator = _chain(tmp_path, effort=200)
    simulator.run(0.1)
    simulator.world.spawn("unit_box", (3.0, 0.0, 0.5))
    simulator.run(4.9)
    assert simulator.state.position("joint3") == pytest.approx(POSE[3], abs=1e-11)
