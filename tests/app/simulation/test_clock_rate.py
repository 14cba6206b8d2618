"""Steps that are due by the clock, with the clock in the test's hands."""

from __future__ import annotations

from math import inf

import pytest

from urdfkit.app.simulation.clock_rate import BEHIND, MARKS, ClockRate

DT = 0.01


class Clock:
    now = 5.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def clock() -> Clock:
    return Clock()


@pytest.fixture
def rate(clock: Clock) -> ClockRate:
    rate = ClockRate(DT, clock)
    rate.begin(2.0)
    return rate


@pytest.mark.parametrize(
    ("factor", "seconds", "t", "steps"),
    [
        (1.0, 0.0, 2.0, 0),
        (1.0, 0.05, 2.0, 5),
        (1.0, 0.05, 2.03, 2),
        (1.0, 0.05, 2.2, 0),  # ahead of the clock
        (0.5, 0.06, 2.0, 3),
        (2.0, 0.06, 2.0, 12),
        (1.0, 3.0, 2.0, round(BEHIND / DT)),  # no more than that is caught up
        (2.0, 3.0, 2.0, round(2.0 * BEHIND / DT)),
        (inf, 3.0, 2.0, 1),  # the time of a step is unknown yet
    ],
)
def test_steps_that_are_due(rate: ClockRate, clock: Clock, factor: float, seconds: float, t: float, steps: int) -> None:
    rate.factor = factor
    clock.now += seconds
    assert rate.steps(t) == steps


@pytest.mark.parametrize(
    ("factor", "seconds", "t", "wait"),
    [
        (1.0, 0.0, 2.0, 0.005),  # half a step, from which a step is due by rounding
        (1.0, 0.02, 2.03, 0.015),
        (0.5, 0.02, 2.03, 0.05),
        (2.0, 0.0, 2.03, 0.0175),
        (1.0, 0.1, 2.0, -0.095),  # late
        (inf, 0.0, 2.03, 0.0),
    ],
)
def test_the_wait_for_the_next_step(
    rate: ClockRate, clock: Clock, factor: float, seconds: float, t: float, wait: float
) -> None:
    rate.factor = factor
    clock.now += seconds
    assert rate.wait(t) == pytest.approx(wait, abs=1e-12)


def test_steps_that_take_long_are_fewer(rate: ClockRate, clock: Clock) -> None:
    clock.now += 0.1
    assert rate.steps(2.0) == 10
    rate.took(10, 0.5, 2.1)
    clock.now += 0.5
    assert rate.steps(2.1) == round(BEHIND / 0.05)


def test_time_that_is_too_far_behind_is_dropped(rate: ClockRate, clock: Clock) -> None:
    clock.now += 3.0
    steps = rate.steps(2.0)
    rate.took(steps, 0.0, 2.0 + steps * DT)
    assert rate.steps(2.0 + steps * DT) == 0
    clock.now += 0.03
    assert rate.steps(2.0 + steps * DT) == 3


def test_time_of_sensor_views_is_caught_up(rate: ClockRate, clock: Clock) -> None:
    rate.looked = 0.2
    clock.now += 0.25
    assert rate.steps(2.0) == 25


def test_the_factor_is_measured_over_the_last_marks(rate: ClockRate, clock: Clock) -> None:
    assert rate.real_time_factor == 1.0
    for k in range(2 * MARKS):
        clock.now += 0.5
        rate.mark(2.0 + 0.25 * k if k < MARKS else 2.0 + k)
    assert rate.real_time_factor == pytest.approx(2.0)
    rate.restart(7.0)
    assert rate.real_time_factor == 1.0
    rate.mark(7.0)
    assert rate.real_time_factor == 1.0
    clock.now += 1.0
    rate.mark(6.0)  # set back
    assert rate.real_time_factor == 0.0
