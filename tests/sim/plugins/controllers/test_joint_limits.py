"""Limits of the commands of a joint: the numbers of joint_limits_interface."""

from __future__ import annotations

from math import inf

import pytest

from urdfkit.sim.plugins.controllers.joint_limits import JointLimits, Soft

HARD = JointLimits(-1.0, 2.0, velocity=0.5, effort=10.0)
SOFT = JointLimits(-1.0, 2.0, velocity=0.5, effort=10.0, soft=Soft(-0.8, 1.8, k_position=2.0, k_velocity=4.0))


@pytest.mark.parametrize(
    ("limits", "wanted", "before", "expected"),
    [
        (HARD, 0.02, 0.0, 0.02),
        (HARD, 1.0, 0.0, 0.05),
        (HARD, -1.0, 0.0, -0.05),
        (HARD, 3.0, 1.98, 2.0),
        (HARD, 1.0, 3.0, 1.0),  # beyond a limit by more than a period: to the command
        (HARD, 9.0, 3.0, 2.0),
        (HARD, 0.5, 2.05, 2.0),  # just within reach of the limit
        (JointLimits(-1.0, 2.0, velocity=0.0), 1.0, 0.5, 0.5),
        (JointLimits(), 99.0, 0.0, 99.0),
        (SOFT, 2.0, 1.7, 1.72),  # 0.1 from the soft limit: at most 0.2 per second
        (SOFT, 2.0, 1.9, 1.88),  # beyond it: back
        (SOFT, -1.0, -0.7, -0.72),
    ],
)
def test_positions(limits: JointLimits, wanted: float, before: float, expected: float) -> None:
    assert limits.position(wanted, before, 0.1) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("limits", "wanted", "position", "expected"),
    [
        (HARD, 0.4, 0.0, 0.4),
        (HARD, 0.6, 0.0, 0.5),
        (HARD, -0.6, 0.0, -0.5),
        (SOFT, 0.6, 0.0, 0.5),
        (SOFT, 0.6, 1.7, 0.2),
        (SOFT, 0.6, 1.9, -0.2),
        (SOFT, -0.6, -0.7, -0.2),
        (SOFT, 0.0, -5.0, 0.5),
    ],
)
def test_velocities(limits: JointLimits, wanted: float, position: float, expected: float) -> None:
    assert limits.turning(wanted, position) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("limits", "wanted", "position", "velocity", "expected"),
    [
        (HARD, 12.0, 0.0, 0.5, 10.0),
        (HARD, 12.0, 0.0, 0.51, 0.0),
        (HARD, -12.0, 0.0, 0.51, -10.0),
        (HARD, -12.0, 0.0, -0.5, -10.0),
        (HARD, -12.0, 0.0, -0.51, 0.0),
        (SOFT, 12.0, 0.0, 0.0, 2.0),  # 4 · (0.5 - 0)
        (SOFT, 12.0, 0.0, 0.4, 0.4),
        (SOFT, -12.0, 0.0, 0.4, -3.6),
        (SOFT, 0.0, 0.0, 1.0, -2.0),  # too fast: it is braked
        (SOFT, 0.0, 0.0, 99.0, -10.0),
        (SOFT, 0.0, 0.0, -99.0, 10.0),
    ],
)
def test_efforts(limits: JointLimits, wanted: float, position: float, velocity: float, expected: float) -> None:
    assert limits.exerting(wanted, position, velocity) == pytest.approx(expected)


def test_efforts_are_reduced_where_the_velocity_is_limited() -> None:
    assert [each.cut_efforts for each in (HARD, SOFT, JointLimits(effort=1.0))] == [True, True, False]
    assert JointLimits(velocity=inf, soft=SOFT.soft).cut_efforts
