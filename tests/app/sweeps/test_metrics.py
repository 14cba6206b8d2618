"""Poses on the plane and names of metrics."""

from __future__ import annotations

import math

import pytest

from urdfkit.app.sweeps.metrics import after, between, commanded_path, parse_metric, planar
from urdfkit.errors import UsageError


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
