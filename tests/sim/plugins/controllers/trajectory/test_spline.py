"""Splines through waypoints: their ends, their derivatives, rest before and after."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.sim.plugins.controllers.trajectory.spline import ROUNDING, Trajectory, Waypoint

number = st.floats(-2.0, 2.0)
pair = st.tuples(number, number).map(np.array)


def waypoint(t: float, values: tuple[np.ndarray, ...]) -> Waypoint:
    return Waypoint(t, *values)


@given(st.integers(1, 3), st.tuples(pair, pair, pair), st.tuples(pair, pair, pair), st.floats(0.5, 3.0))
def test_a_segment_begins_and_ends_with_what_its_waypoints_state(degree, first, last, seconds: float) -> None:
    start, end = 1.5, 1.5 + seconds
    trajectory = Trajectory([waypoint(start, first[:degree]), waypoint(end, last[:degree])])
    assert trajectory.end == end
    for t, stated in ((start, first), (end, last)):
        for found, expected in zip(trajectory.at(t)[:degree], stated[:degree], strict=True):
            assert found == pytest.approx(expected, abs=1e-8)
    # The degree is the lowest one, so its highest power has the same derivative at all times.
    times = np.linspace(start, end, 2 * degree + 2)
    values = np.array([trajectory.at(t)[0] for t in times])
    assert np.abs(np.diff(values, 2 * degree, axis=0)).max() < 1e-7


@given(st.integers(1, 3), st.tuples(pair, pair, pair), st.tuples(pair, pair, pair))
def test_velocities_and_accelerations_are_derivatives(degree, first, last) -> None:
    trajectory = Trajectory([waypoint(0.0, first[:degree]), waypoint(2.0, last[:degree])])
    for t in (0.3, 1.0, 1.8):
        (before, slope, _), (_, velocity, acceleration), (after, later, _) = (
            trajectory.at(t + h) for h in (-1e-4, 0, 1e-4)
        )
        assert velocity == pytest.approx((after - before) / 2e-4, abs=1e-4)
        assert acceleration == pytest.approx((later - slope) / 2e-4, abs=1e-4)


def test_a_trajectory_rests_at_its_ends_and_follows_the_one_before() -> None:
    one, two, three = (np.array([each]) for each in (1.0, 3.0, 4.0))
    first = Trajectory([Waypoint(0.0, one), Waypoint(2.0, two)])
    second = Trajectory([Waypoint(1.0, two), Waypoint(2.0, three), Waypoint(4.0, one)], before=first)

    def at(trajectory: Trajectory, t: float) -> tuple[float, ...]:
        return tuple(float(each[0]) for each in trajectory.at(t))

    assert at(first, -1.0) == (1.0, 0.0, 0.0)
    assert at(first, 0.0) == (1.0, 1.0, 0.0)
    assert at(first, 2.0) == at(first, 2.0 + ROUNDING / 2) == (3.0, 1.0, 0.0)
    assert at(first, 2.1) == (3.0, 0.0, 0.0)
    assert at(second, 0.5) == (1.5, 1.0, 0.0)
    assert at(second, 1.0) == (3.0, 1.0, 0.0)
    assert at(second, 2.0) == (4.0, -1.5, 0.0)
    assert at(second, 3.0) == (2.5, -1.5, 0.0)
    assert at(Trajectory([Waypoint(1.0, two)]), 1.0) == (3.0, 0.0, 0.0)


def test_waypoints_at_the_same_time_are_a_jump() -> None:
    one, two = np.array([1.0]), np.array([2.0])
    trajectory = Trajectory([Waypoint(0.0, one), Waypoint(1.0, one), Waypoint(1.0, two), Waypoint(2.0, two)])
    assert [float(trajectory.at(t)[0][0]) for t in (0.5, 1.0, 1.5)] == [1.0, 2.0, 2.0]


def test_a_velocity_or_acceleration_at_one_end_only_is_ignored() -> None:
    zero, one = np.array([0.0]), np.array([1.0])
    line = Trajectory([Waypoint(0.0, zero, one), Waypoint(2.0, one)])
    assert float(line.at(1.0)[1][0]) == 0.5
    cubic = Trajectory([Waypoint(0.0, zero, zero, one), Waypoint(2.0, one, zero)])
    assert float(cubic.at(0.0)[2][0]) == 1.5
