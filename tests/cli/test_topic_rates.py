"""Statistics of rates and sizes, and how they are printed."""

from __future__ import annotations

import pytest

from urdfkit.cli.topic.rates import Statistics, Window, report


def filled(size: int, *messages: tuple[float, int]) -> Window:
    window = Window(size)
    for t, bytes_ in messages:
        window.add(t, bytes_)
    return window


def test_periods_and_sizes_are_those_of_the_window() -> None:
    window = filled(3, (0.0, 900), (1.0, 100), (1.5, 200), (2.5, 600))  # the first one has left it
    assert window.new == 4
    assert window.periods() == Statistics(2 / 1.5, 0.75, 0.5, 1.0, 0.25, 3)
    sizes = window.sizes()
    assert sizes is not None
    assert (sizes.rate, sizes.mean, sizes.min, sizes.max, sizes.window) == (800 / 1.5, 300.0, 100.0, 600.0, 3)
    assert sizes.std == pytest.approx((140_000 / 3) ** 0.5)


@pytest.mark.parametrize("messages", [[], [(1.0, 10)], [(1.0, 10), (1.0, 20)]], ids=["none", "one", "at one time"])
def test_nothing_is_measured_before_time_has_passed(messages: list[tuple[float, int]]) -> None:
    window = filled(10, *messages)
    assert window.periods() is None
    assert window.sizes() is None


def test_a_reset_starts_again() -> None:
    window = filled(10, (5.0, 1), (6.0, 1), (0.0, 1), (0.5, 1))
    assert window.periods() == Statistics(2.0, 0.5, 0.5, 0.5, 0.0, 2)


@pytest.mark.parametrize(
    ("factor", "text"),
    [
        (1.0, "average: 500.00B/s\n\tmean: 50.00B min: 25.00B max: 75.00B std dev: 12.50B window: 7"),
        (2.0, "average: 1.00KB/s\n\tmean: 0.10KB min: 0.05KB max: 0.15KB std dev: 0.03KB window: 7"),
        (2e3, "average: 1.00MB/s\n\tmean: 0.10MB min: 0.05MB max: 0.15MB std dev: 0.03MB window: 7"),
    ],
)
def test_sizes_have_the_unit_of_the_rate(factor: float, text: str) -> None:
    statistics = Statistics(500.0 * factor, 50.0 * factor, 25.0 * factor, 75.0 * factor, 12.5 * factor, 7)
    assert report(statistics, is_hz=False) == text


def test_rates_are_printed_as_rostopic_does() -> None:
    text = "average rate: 20.000\n\tmin: 0.040s max: 0.060s std dev: 0.00250s window: 9"
    assert report(Statistics(20.0, 0.05, 0.04, 0.06, 0.0025, 9), is_hz=True) == text
