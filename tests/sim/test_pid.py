from math import inf

import pytest

from urdfkit.sim.state.pid import Gains, GazeboPid


def test_the_error_is_what_is_minus_what_should_be() -> None:
    assert GazeboPid(Gains(2.0, 0.0, 0.0)).update(0.5, 0.01) == -1.0


def test_the_integral_is_bounded_by_what_it_may_exert() -> None:
    pid = GazeboPid(Gains(0.0, 10.0, 0.0, -0.3, 0.3))
    assert [pid.update(1.0, 0.01) for _ in range(4)] == pytest.approx([-0.1, -0.2, -0.3, -0.3])
    assert pid.update(-1.0, 0.01) == pytest.approx(-0.2)


def test_without_a_range_there_is_no_integral() -> None:
    assert GazeboPid(Gains(0.0, 10.0, 0.0)).update(1.0, 0.01) == 0.0


def test_the_derivative_is_of_the_error() -> None:
    pid = GazeboPid(Gains(0.0, 0.0, 0.5))
    assert pid.update(0.1, 0.01) == pytest.approx(-5.0)
    assert pid.update(0.1, 0.01) == pytest.approx(0.0)
    pid.reset()
    assert pid.update(0.1, 0.01) == pytest.approx(-5.0)


def test_the_command_has_bounds_and_an_offset() -> None:
    pid = GazeboPid(Gains(1.0, 0.0, 0.0), bounds=(-0.5, inf), offset=0.2)
    assert pid.update(0.1, 0.01) == pytest.approx(0.1)
    assert pid.update(3.0, 0.01) == -0.5


def test_idle() -> None:
    assert GazeboPid(Gains(0.0, 0.0, 0.0, -1.0, 1.0)).idle
    assert not GazeboPid(Gains(0.0, 0.0, 1.0)).idle
