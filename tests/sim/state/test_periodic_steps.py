from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.sim.state.periodic_steps import PeriodicSteps

RATES = st.sampled_from([1.0, 7.0, 10.0, 25.0, 30.0, 40.0, 50.0, 60.0, 100.0, 333.0, 1000.0])
STEPS = st.sampled_from([0.0005, 0.001, 0.002, 0.003, 0.005, 0.01])


@given(RATES, STEPS, st.integers(0, 10**7))
def test_ticks_do_not_drift(rate: float, dt: float, step: int) -> None:
    ticks = PeriodicSteps(rate, dt)
    exact = max(Fraction(1), 1 / (Fraction(str(rate)) * Fraction(str(dt))))
    assert ticks.until(step) == step // exact
    assert ticks.at(ticks.until(step)) <= step < ticks.after(step)
    assert ticks.next(ticks.after(step)) == ticks.after(step)


@given(RATES, STEPS)
def test_no_step_between_two_ticks_is_one(rate: float, dt: float) -> None:
    ticks = PeriodicSteps(rate, dt)
    first, second = ticks.after(100), ticks.after(ticks.after(100))
    assert not any(ticks.next(step) == step for step in range(first + 1, second))


@pytest.mark.parametrize("rate", [0.0, -1.0, 1e6])
def test_no_rate_is_every_step(rate: float) -> None:
    ticks = PeriodicSteps(rate, 0.001)
    assert [step for step in range(5) if ticks.next(step) == step] == [0, 1, 2, 3, 4]
    assert ticks.until(7) == 7


def test_forty_hertz_for_ten_seconds_is_four_hundred() -> None:
    assert PeriodicSteps(40.0, 0.001).until(10_000) == 400
    assert PeriodicSteps(40.0, 0.005).until(2_000) == 400
