from math import atan, cos, hypot, pi, sin, tan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.sim.plugins.wheel_odometry import (
    BicycleOdometry,
    DifferentialOdometry,
    FourWheelOdometry,
    MecanumOdometry,
)


def drive(odometry: DifferentialOdometry, v: float, w: float, seconds: float, rate: float, separation: float) -> None:
    for n in range(round(seconds * rate) + 1):
        t = n / rate
        odometry.update(t, (v - w * separation / 2) * t, (v + w * separation / 2) * t)


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(0.1, 1))
def test_the_exact_arc_is_exact_at_any_rate(v: float, w: float, separation: float) -> None:
    odometry = DifferentialOdometry(separation, exact=True)
    drive(odometry, v, w, 4.0, 2.0, separation)
    angle = w * 4.0
    x, y = (v * 4.0, 0.0) if abs(w) < 1e-6 else (v / w * sin(angle), v / w * (1 - cos(angle)))
    assert odometry.heading == pytest.approx(angle, abs=1e-12)
    assert (odometry.x, odometry.y) == pytest.approx((x, y), abs=1e-5)


def test_the_mid_point_is_longer_by_a_24th_of_the_turn_squared() -> None:
    odometry = DifferentialOdometry(0.4)
    drive(odometry, 0.5, 0.5, 10.0, 100.0, 0.4)
    error = ((odometry.x - sin(5.0)) ** 2 + (odometry.y - (1 - cos(5.0))) ** 2) ** 0.5
    assert error < 1.1 * (0.005**2 / 24) * 2
    assert odometry.heading == pytest.approx(5.0)


def test_the_first_update_only_remembers() -> None:
    odometry = DifferentialOdometry(0.4)
    assert not odometry.started
    odometry.update(0.0, 17.0, 18.0)
    assert odometry.started
    assert (odometry.x, odometry.y, odometry.heading, odometry.distance) == (0, 0, 0, 0)


def test_backwards_has_a_positive_length_and_a_negative_arc() -> None:
    odometry = DifferentialOdometry(0.4)
    odometry.update(0.0, 0.0, 0.0)
    odometry.update(0.1, -0.1, -0.1)
    assert (odometry.x, odometry.distance, odometry.moved[0]) == pytest.approx((-0.1, 0.1, -0.1))


def test_turning_on_the_spot_stays_on_the_spot() -> None:
    odometry = DifferentialOdometry(0.5)
    drive(odometry, 0.0, pi / 2, 4.0, 100.0, 0.5)
    assert (odometry.x, odometry.y, odometry.heading) == pytest.approx((0, 0, 2 * pi), abs=1e-12)


@given(st.floats(-1, 1), st.floats(-0.6, 0.6))
def test_the_bicycle_is_exact_at_any_rate(v: float, angle: float) -> None:
    odometry = BicycleOdometry(0.8)
    for n in range(9):
        odometry.update(n / 2, v * n / 2, angle)
    w = v * tan(angle) / 0.8
    x, y = (v * 4.0, 0.0) if abs(w) < 1e-6 else (v / w * sin(w * 4.0), v / w * (1 - cos(w * 4.0)))
    assert odometry.heading == pytest.approx(w * 4.0, abs=1e-12)
    assert (odometry.x, odometry.y) == pytest.approx((x, y), abs=1e-5)
    assert odometry.moved[0] == pytest.approx(v / 2)


@pytest.mark.parametrize("turn", [0.4, -0.4])
def test_each_of_two_wheels_gives_the_bicycle_the_way_of_their_middle(turn: float) -> None:
    base, track, way = 0.8, 0.6, 0.5  # the middle turns by 0.4 rad on 0.5 m
    angle, odometry = atan(base * turn / way), BicycleOdometry(base, track)
    right, left = way + turn * track / 2, way - turn * track / 2
    assert odometry.middle((right, left), angle) == pytest.approx(way)
    assert odometry.middle((right + 0.1, left), angle) == pytest.approx(way + 0.05 * way / right)
    assert odometry.middle((way,), angle) == way
    odometry.update(0.0, 7.0, 8.0, angle - 0.1)
    odometry.update(1.0, 7.0 + right, 8.0 + left, angle + 0.1)
    assert odometry.moved == pytest.approx((way, 0.0, turn))


@given(st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))
def test_mecanum_wheels_are_exact_at_any_rate(vx: float, vy: float, w: float) -> None:
    odometry = MecanumOdometry(0.4)
    for n in range(9):
        t, turn = n / 2, w * 0.4
        odometry.update(t, *((vx + s * vy + r * turn) * t for s, r in ((-1, -1), (1, 1), (1, -1), (-1, 1))))
    angle = w * 4.0
    s, c = (4.0, 0.0) if abs(w) < 1e-6 else (sin(angle) / w, (1 - cos(angle)) / w)
    assert odometry.heading == pytest.approx(angle, abs=1e-12)
    assert (odometry.x, odometry.y) == pytest.approx((vx * s - vy * c, vx * c + vy * s), abs=1e-5)
    assert odometry.moved == pytest.approx((vx / 2, vy / 2, w / 2), abs=1e-12)


@given(st.floats(-1, 1), st.floats(-0.6, 0.6), st.floats(-0.6, 0.6))
def test_four_steered_wheels_that_roll_without_slip_move_as_their_axles_do(v: float, front: float, rear: float) -> None:
    base, track = 1.2, 0.8
    turn = v * (tan(front) - tan(rear)) / base  # of a body whose middle moves along x at v
    left = v * (tan(front) + tan(rear)) / 2
    ways = []
    for x in (base / 2, -base / 2):
        for y in (track / 2, -track / 2):
            velocity = v - turn * y, left + turn * x
            ways.append(hypot(*velocity) * (1 if velocity[0] >= 0 else -1))
    found = FourWheelOdometry(base, track, 0.0).displacement(ways, front, rear)
    assert found == pytest.approx((v, left, turn), abs=1e-9)


def test_four_wheels_are_integrated_at_the_mean_of_their_steering_angles() -> None:
    base, track, offset = 1.2, 0.8, 0.1
    odometry = FourWheelOdometry(base, track, offset)
    readings = (1.0, 1.1, 1.2, 1.3, 0.1, -0.2), (1.5, 1.7, 1.8, 2.0, 0.3, 0.1)
    for t, reading in enumerate(readings):
        odometry.update(float(t), *reading)
    expected = FourWheelOdometry(base, track, offset).displacement((0.5, 0.6, 0.6, 0.7), 0.2, -0.05)
    assert odometry.moved == pytest.approx(expected)
    assert odometry.velocity == odometry.moved


def test_wheels_beside_their_steering_joints_roll_less_on_the_inner_side() -> None:
    base, track, offset, front = 1.2, 0.8, 0.1, 0.5
    rear = -front
    radius = base / 2 / tan(front)  # of the path of the middle
    ways = []
    for side in (1, -1):  # the knuckle is at half the track, the wheel `offset` outside of it
        knuckle = hypot(base / 2, radius - side * track / 2)
        ways.append(knuckle - side * offset)
    found = FourWheelOdometry(base, track, offset).displacement([*ways, *ways], front, rear)
    assert found == pytest.approx((radius, 0.0, 1.0), abs=1e-9)  # of a turn of 1 rad


def test_the_first_look_at_the_wheels_only_remembers() -> None:
    bicycle, mecanum = BicycleOdometry(1.0), MecanumOdometry(1.0)
    assert not bicycle.started
    assert not mecanum.started
    bicycle.update(0.0, 17.0, 0.3)
    mecanum.update(0.0, 1.0, 2.0, 3.0, 4.0)
    assert bicycle.started
    assert mecanum.started
    assert (bicycle.x, bicycle.y, bicycle.heading, mecanum.x, mecanum.y, mecanum.heading) == (0,) * 6
