"""Position targets of joints with limits of acceleration, against the trapezoidal velocity profile."""

from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest

from urdfkit.sim import Simulator

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
