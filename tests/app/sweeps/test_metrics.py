"""Poses on the plane and names of metrics."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from urdfkit.app.sweeps.metrics import Measurement, after, between, commanded_path, parse_metric, planar
from urdfkit.errors import UsageError
from urdfkit.sim import Simulator


@pytest.mark.parametrize("yaw", [-3.0, -0.5, 0.0, 1.0, 2.5])
def test_position_and_yaw_of_a_pose(yaw: float) -> None:
    tilted = (math.sin(0.5 * yaw), math.cos(0.5 * yaw))
    assert planar((1.0, 2.0, 3.0, 0.0, 0.0, *tilted)) == pytest.approx((1.0, 2.0, yaw))


def test_a_roll_does_not_change_the_yaw() -> None:
    c, s = math.cos(0.2), math.sin(0.2)
    turn = (0.3, 0.4)  # half the yaw and half the roll
    x, y = math.cos(turn[0]) * math.sin(turn[1]), math.sin(turn[0]) * math.sin(turn[1])
    z, w = math.sin(turn[0]) * math.cos(turn[1]), math.cos(turn[0]) * math.cos(turn[1])
    assert planar((0.0, 0.0, 0.0, x, y, z, w))[2] == pytest.approx(0.6)
    assert planar((0.0, 0.0, 0.0, 0.0, s, 0.0, c))[2] == 0.0  # a pitch


def test_relative_poses() -> None:
    quarter = 0.5 * math.pi
    assert after((1.0, 2.0, quarter), (3.0, 4.0, 0.1)) == pytest.approx((-3.0, 5.0, quarter + 0.1))
    assert between((1.0, 2.0, quarter), (-3.0, 5.0, quarter + 0.1)) == pytest.approx((3.0, 4.0, 0.1))
    first, second = (0.3, -0.7, 0.9), (-1.1, 0.2, 2.2)
    assert after(first, between(first, second)) == pytest.approx(second)


@pytest.mark.parametrize(
    ("command", "ramp", "t", "expected"),
    [
        ((2.0, 1.0, 0.0), 0.0, 3.0, (6.0, 3.0, 0.0)),
        ((2.0, 0.0, 0.0), 1.0, 0.5, (0.25, 0.0, 0.0)),
        ((2.0, 0.0, 0.0), 1.0, 1.0, (1.0, 0.0, 0.0)),
        ((2.0, 0.0, 0.0), 1.0, 2.0, (3.0, 0.0, 0.0)),
        ((1.0, 0.0, 0.5), 0.0, math.pi, (2.0, 2.0, 0.5 * math.pi)),  # a quarter of a circle of 2 m
        ((0.0, 1.0, 0.5), 0.0, math.pi, (-2.0, 2.0, 0.5 * math.pi)),
        ((1.0, 0.0, -0.5), 0.0, math.pi, (2.0, -2.0, -0.5 * math.pi)),
        ((1.0, 0.0, 0.5), 2.0, math.pi + 1.0, (2.0, 2.0, 0.5 * math.pi)),
    ],
)
def test_the_path_of_a_command(
    command: tuple[float, float, float], ramp: float, t: float, expected: tuple[float, float, float]
) -> None:
    assert commanded_path(command, ramp)(t) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("text", "name", "expression"),
    [
        ("highest(x)", "highest(x)", "highest(x)"),
        (" far = highest(x) ", "far", "highest(x)"),
        ("x == 1", "x == 1", "x == 1"),
        ("ok=x == 1", "ok", "x == 1"),
    ],
)
def test_a_metric_may_have_a_name(text: str, name: str, expression: str) -> None:
    assert parse_metric(text) == (name, expression)


def test_a_metric_is_an_expression() -> None:
    with pytest.raises(UsageError):
        parse_metric("far=highest(x")


@pytest.fixture
def gliding() -> Simulator:
    """Return a robot that glides through space at 0.5 m/s along y, from x = 2 m, heading along y."""
    simulator = Simulator("simpleton", world="void", gravity=(0.0, 0.0, 0.0), note=lambda _: None)
    simulator.world.place("simpleton", (2.0, 0.0, 1.0, 0.0, 0.0, 0.5 * math.pi), (0.0, 0.5, 0.0, 0.0, 0.0, 0.0))
    return simulator


def test_metrics_of_a_run(gliding: Simulator) -> None:
    mass = sum(link.inertial.mass for link in gliding.robot.links if link.inertial is not None)
    metrics = {
        "far": "highest(y)",
        "near": "lowest(y) + 1",
        "middle": "2 * mean(y)",
        "span": "highest(y) - lowest(y)",
        "end": "y",
        "path": "path_error",
        "odometry": "odometry_error",
        "kinetic": "highest(kinetic_energy)",
        "potential": "potential_energy",
    }
    measurement = Measurement(gliding, metrics, commanded_path((0.2, 0.1, 0.0), 0.0))
    gliding.run(2.0)
    found = measurement.results()
    assert {name: found[name] for name in ("far", "near", "middle", "span", "end")} == pytest.approx(
        {"far": 1.0, "near": 1.0, "middle": 1.0, "span": 1.0, "end": 1.0}, abs=0.01
    )
    assert found["path"] == pytest.approx(math.hypot(0.2, 0.6))  # 0.4 m ahead along y and 0.2 m to the left
    assert found["odometry"] == pytest.approx(1.0)  # the wheels do not roll
    assert found["kinetic"] == pytest.approx(0.5 * mass * 0.5**2)
    assert found["potential"] == 0.0


@pytest.mark.parametrize(
    ("expression", "reason"),
    [
        ("path_error", "path_error is the distance to the path of a velocity command: add --cmd-vel"),
        ("highest(x, y)", "`highest(x, y)` needs one expression"),
        ("highest()", "`highest()` needs one expression"),
        ("mean(x=1)", "`mean(x=1)` needs one expression"),
    ],
)
def test_a_metric_that_has_no_value(gliding: Simulator, expression: str, reason: str) -> None:
    with pytest.raises(UsageError) as refused:
        Measurement(gliding, {"it": expression})
    assert str(refused.value) == f"--metric: {reason}"


def test_a_robot_without_odometry_has_no_error_of_it(tmp_path: Path) -> None:
    (tmp_path / "r.urdf").write_text(
        '<robot name="r"><link name="base"><inertial><mass value="1"/>'
        '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>'
    )
    simulator = Simulator(tmp_path / "r.urdf", note=lambda _: None)
    with pytest.raises(UsageError, match="--metric: odometry_error: robot `r` publishes no odometry"):
        Measurement(simulator, {"it": "odometry_error"})
