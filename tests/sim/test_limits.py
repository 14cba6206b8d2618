from math import inf

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.sim.plugins.speed_limits import SpeedLimiter

DT = 0.001


def test_without_limits_everything_is_granted() -> None:
    limiter = SpeedLimiter()
    assert limiter.limit(3.7, DT) == 3.7
    assert not limiter.settled(3.7)
    limiter.limit(3.7, DT)
    assert limiter.settled(3.7)


def test_the_lower_limit_does_not_follow_from_the_upper() -> None:
    limiter = SpeedLimiter(velocity=(-inf, 0.5))
    assert limiter.limit(2.0, DT) == 0.5
    assert limiter.limit(-2.0, DT) == -2.0


def test_acceleration_is_a_straight_ramp() -> None:
    limiter = SpeedLimiter(acceleration=(-2.0, 1.0))
    speeds = [limiter.limit(0.5, DT) for _ in range(600)]
    assert speeds[0] == pytest.approx(0.001)
    assert speeds[249] == pytest.approx(0.25)
    assert speeds[-1] == 0.5
    slowing = [limiter.limit(0.0, DT) for _ in range(250)]
    assert slowing[-1] == pytest.approx(0.0, abs=1e-9)


def test_jerk_bends_the_ramp() -> None:
    limiter = SpeedLimiter(jerk=(-10.0, 10.0))
    speeds = [limiter.limit(100.0, DT) for _ in range(100)]
    assert speeds[-1] == pytest.approx(10.0 / 2 * 0.1**2, rel=0.02)


@given(st.lists(st.floats(-5, 5), min_size=1, max_size=50))
def test_limits_hold_for_any_command(wanted: list[float]) -> None:
    limiter = SpeedLimiter(velocity=(-1.0, 2.0), acceleration=(-3.0, 4.0))
    last = 0.0
    for value in wanted:
        granted = limiter.limit(value, DT)
        assert -1.0 <= granted <= 2.0
        assert -3.0 * DT - 1e-12 <= granted - last <= 4.0 * DT + 1e-12
        last = granted
