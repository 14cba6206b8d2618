"""Sliders of controllers: their rows on the page, and the message of each kind of controller."""

from __future__ import annotations

from collections.abc import Callable
from math import pi
from pathlib import Path
from typing import Any

import pytest

from tests.sim import arm_package
from urdfkit.app.simulation.features.joint_sliders import ControllerSliders
from urdfkit.errors import UrdfkitError
from urdfkit.messages import FLOAT, FLOATS, TRAJECTORY
from urdfkit.sim import Simulator

PID = "pid: {p: 10.0, i: 0.0, d: 1.0}"
Make = Callable[..., tuple[Simulator, ControllerSliders]]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    def build(controller: str, interface: str, **arm: Any) -> tuple[Simulator, ControllerSliders]:
        arm_package.write_control(tmp_path, f"arm:\n  it: {{{controller}}}\n")
        urdf = arm_package.write_arm(tmp_path, arm_package.transmissions(interface, interface), **arm)
        simulator = Simulator(urdf, note=lambda _: None, gravity=(0, 0, 0))
        (robot,) = simulator.world.robots.values()
        (plugin,) = (each for each in robot.plugins.controllers if each.loop is not None)
        return simulator, ControllerSliders(robot, plugin.loop.controllers["it"])

    return build


@pytest.mark.parametrize(
    ("controller", "interface", "of", "unit", "most"),
    [
        (f"effort_controllers/JointPositionController, joint: elbow, {PID}", "Effort", "position", "rad", 2.5),
        ("position_controllers/JointPositionController, joint: elbow", "Position", "position", "rad", 2.5),
        (f"effort_controllers/JointVelocityController, joint: elbow, {PID}", "Effort", "velocity", "rad/s", 3.0),
        ("velocity_controllers/JointVelocityController, joint: elbow", "Velocity", "velocity", "rad/s", 3.0),
        ("effort_controllers/JointEffortController, joint: elbow", "Effort", "effort", "N·m", 7.0),
    ],
)
def test_a_controller_of_one_joint(
    make: Make, controller: str, interface: str, of: str, unit: str, most: float
) -> None:
    simulator, arm = make(f"type: {controller}", interface, effort=7.0, velocity=3.0)
    joint = {"name": "elbow", "lower": -most, "upper": most, "unit": unit, "value": 0.0}
    kind = controller.partition(",")[0]
    assert arm.row() == {"name": "arm/it", "type": kind, "of": of, "running": True, "joints": [joint]}
    sent: list[float] = []
    simulator.subscribe("/arm/it/command", FLOAT, lambda message: sent.append(message.data))
    arm.command(simulator.bus, "elbow", 0.25)
    assert sent == [0.25]
    assert arm.row()["joints"] == [joint | {"value": 0.25}]
    with pytest.raises(UrdfkitError, match="unknown joint `elbo` in `arm/it`; did you mean `elbow`"):
        arm.command(simulator.bus, "elbo", 0.25)


def test_a_joint_without_limits_has_the_range_of_a_turn(make: Make) -> None:
    _, arm = make("type: position_controllers/JointPositionController, joint: elbow", "Position", elbow="continuous")
    (joint,) = arm.row()["joints"]
    assert (joint["lower"], joint["upper"]) == (-pi, pi)


def test_a_group_gets_the_last_commands_of_all_joints(make: Make) -> None:
    simulator, arm = make(
        "type: velocity_controllers/JointGroupVelocityController, joints: [shoulder, elbow]", "Velocity"
    )
    sent: list[list[float]] = []
    simulator.subscribe("/arm/it/command", FLOATS, lambda message: sent.append(list(message.data)))
    arm.command(simulator.bus, "elbow", 0.25)
    arm.command(simulator.bus, "shoulder", -1.0)
    assert sent == [[0.0, 0.25], [-1.0, 0.25]]


def test_a_trajectory_takes_the_time_of_half_the_velocity_of_the_joint_with_the_longest_way(make: Make) -> None:
    kind = "type: position_controllers/JointTrajectoryController, joints: [shoulder, elbow]"
    simulator, arm = make(kind, "Position", velocity=0.5)
    sent: list[Any] = []
    simulator.subscribe("/arm/it/command", TRAJECTORY, sent.append)
    for joint, value in (("elbow", -0.625), ("shoulder", 0.25), ("elbow", 0.01), ("shoulder", 0.01)):
        arm.command(simulator.bus, joint, value)
    assert [each.joint_names for each in sent] == [["shoulder", "elbow"]] * 4
    points = [point for each in sent for point in each.points]
    assert [point.positions.tolist() for point in points] == [[0, -0.625], [0.25, -0.625], [0.25, 0.01], [0.01, 0.01]]
    times = [(point.time_from_start.sec, point.time_from_start.nanosec) for point in points]
    assert times == [(2, 500_000_000), (2, 500_000_000), (1, 0), (0, 100_000_000)]  # at 0.25 rad/s, at least 0.1 s
