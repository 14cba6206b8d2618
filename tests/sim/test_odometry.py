from math import cos, pi, sin

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.sim.odometry import WheelOdometry


def drive(odometry: WheelOdometry, v: float, w: float, seconds: float, rate: float, separation: float) -> None:
    for n in range(round(seconds * rate) + 1):
        t = n / rate
        odometry.update((v - w * separation / 2) * t, (v + w * separation / 2) * t)


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.1, 1))
def test_the_exact_arc_is_exact_at_any_rate(v: float, w: float, separation: float) -> None:
    odometry = WheelOdometry(separation, exact=True)
    drive(odometry, v, w, 4.0, 2.0, separation)
    angle = w * 4.0
    x, y = (v * 4.0, 0.0) if abs(w) < 1e-6 else (v / w * sin(angle), v / w * (1 - cos(angle)))
    assert odometry.heading == pytest.approx(angle, abs=1e-12)
    assert (odometry.x, odometry.y) == pytest.approx((x, y), abs=1e-5)


def test_the_mid_point_is_longer_by_a_24th_of_the_turn_squared() -> None:
    odometry = WheelOdometry(0.4)
    drive(odometry, 0.5, 0.5, 10.0, 100.0, 0.4)
    error = ((odometry.x - sin(5.0)) ** 2 + (odometry.y - (1 - cos(5.0))) ** 2) ** 0.5
    assert error < 1.1 * (0.005**2 / 24) * 2
    assert odometry.heading == pytest.approx(5.0)


def test_the_first_update_only_remembers() -> None:
    odometry = WheelOdometry(0.4)
    assert not odometry.started
    odometry.update(17.0, 18.0)
    assert odometry.started
    assert (odometry.x, odometry.y, odometry.heading, odometry.distance) == (0, 0, 0, 0)


def test_backwards_has_a_positive_length_and_a_negative_arc() -> None:
    odometry = WheelOdometry(0.4)
    odometry.update(0.0, 0.0)
    odometry.update(-0.1, -0.1)
    assert (odometry.x, odometry.distance, odometry.advanced) == pytest.approx((-0.1, 0.1, -0.1))


def test_turning_on_the_spot_stays_on_the_spot() -> None:
    odometry = WheelOdometry(0.5)
    drive(odometry, 0.0, pi / 2, 4.0, 100.0, 0.5)
    assert (odometry.x, odometry.y, odometry.heading) == pytest.approx((0, 0, 2 * pi), abs=1e-12)
