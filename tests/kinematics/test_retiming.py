"""The fastest motion along waypoints: within the limits, on the path, and as fast as closed forms and ruckig."""

from dataclasses import replace

import numpy as np
import pytest
from ruckig import InputParameter, Ruckig
from ruckig import Trajectory as Profile
from scipy.interpolate import CubicSpline

from urdfkit.errors import KinematicsError
from urdfkit.kinematics.retiming import MotionLimits, retime

JOINTS = 5


def limits_of(*, jerk=None):
    wide = np.full(JOINTS, 9.0)
    jerks = None if jerk is None else np.full(JOINTS, jerk)
    return MotionLimits(
        tuple("abcde"), -wide, wide, np.linspace(1.0, 2.0, JOINTS), np.linspace(3.0, 5.0, JOINTS), jerks
    )


@pytest.mark.parametrize("jerk", [None, 25.0])
@pytest.mark.parametrize("count", [2, 3, 12])
def test_motions_pass_all_waypoints_within_the_limits(count, jerk):
    waypoints = np.random.default_rng(count).uniform(-1.5, 1.5, (count, JOINTS))
    limits = limits_of(jerk=jerk)
    motion = retime(waypoints, limits, rate=1000.0)
    passed = np.stack([np.interp(motion.waypoint_times, motion.time, column) for column in motion.position.T], axis=1)
    assert np.abs(passed - waypoints).max() < 1e-4  # between samples of 1 ms
    assert np.abs(motion.velocity[[0, -1]]).max() < 1e-9
    # Differences of the positions, not the derivatives that the motion states.
    steps = np.diff(motion.time)[:-1, None]
    rates = np.diff(motion.position[:-1], axis=0) / steps
    accelerations = np.diff(rates, axis=0) / steps[1:]
    assert (np.abs(rates) <= limits.velocity * (1 + 1e-6)).all()
    assert (np.abs(accelerations) <= limits.acceleration * (1 + 1e-3)).all()
    if jerk is not None:
        assert (np.abs(np.diff(accelerations, axis=0) / steps[2:]) <= jerk * 1.01).all()
    # The stated accelerations are the slopes of the velocities, except where they jump.
    slopes = np.gradient(motion.velocity, motion.time, axis=0)
    assert np.quantile(np.abs(slopes - motion.acceleration), 0.9) < 0.01
    # It is as fast as the limits allow: one of them is nearly reached.
    used = np.max(np.abs(motion.acceleration) / limits.acceleration), np.max(np.abs(motion.velocity) / limits.velocity)
    assert max(used) > 0.98


def test_the_way_between_waypoints_bends_by_the_time_that_each_part_takes():
    points = np.zeros((3, JOINTS))
    points[1:, 0], points[2, 4] = 0.2, 1.0
    parts = [0.2 / 1.0, 1.0 / 2.0]  # at the limits of velocity of the first and of the last joint
    way = CubicSpline([0.0, parts[0], sum(parts)], points, bc_type="natural")(np.linspace(0.0, sum(parts), 5001))
    passed = retime(points, limits_of()).position
    assert max(np.abs(way - each).max(axis=1).min() for each in passed) < 1e-3


def test_a_straight_line_takes_the_time_of_a_trapezoid():
    motion = retime(np.array([[0.0] * JOINTS, [2.0, 0.0, 0.0, 0.0, 0.0]]), limits_of())
    assert motion.duration == pytest.approx(2.0 / 1.0 + 1.0 / 3.0, rel=1e-3)  # distance / v + v / a


def test_a_straight_line_with_jerk_takes_the_time_of_ruckig_for_its_slowest_joint():
    motion = retime(np.array([[0.0] * JOINTS, [2.0, 0.0, 0.0, 0.0, 0.0]]), limits_of(jerk=25.0))
    wanted = InputParameter(1)
    wanted.current_position, wanted.target_position = [0.0], [2.0]
    wanted.max_velocity, wanted.max_acceleration, wanted.max_jerk = [1.0], [3.0], [25.0]
    profile = Profile(1)
    Ruckig(1).calculate(wanted, profile)
    assert motion.duration == pytest.approx(profile.duration, rel=1e-4)


def test_an_averaged_motion_is_hardly_slower_than_ruckig_on_the_same_line():
    ends = np.array([[0.0] * JOINTS, [2.0, 1.0, 0.0, -1.0, 0.5]])
    three = np.stack([ends[0], ends.mean(axis=0), ends[1]])
    limits = limits_of(jerk=25.0)
    assert retime(three, limits).duration < 1.02 * retime(ends, limits).duration


def test_a_higher_limit_of_jerk_comes_closer_to_the_motion_without_one():
    waypoints = np.random.default_rng(3).uniform(-1.0, 1.0, (6, JOINTS))
    durations = [retime(waypoints, limits_of(jerk=jerk)).duration for jerk in (10.0, 100.0, 10_000.0)]
    assert durations == sorted(durations, reverse=True)
    assert durations[-1] < 1.02 * retime(waypoints, limits_of()).duration


def test_repeated_waypoints_count_once():
    waypoints = np.array([[0.0] * JOINTS, [0.0] * JOINTS, [1.0] * JOINTS])
    motion = retime(waypoints, limits_of())
    assert motion.waypoint_times.tolist() == [0.0, 0.0, pytest.approx(motion.duration)]


def test_too_many_samples_are_refused():
    with pytest.raises(KinematicsError, match=r"samples per second exceed 1e\+07 samples; use a lower rate"):
        retime(np.array([[0.0] * JOINTS, [1.0] * JOINTS]), limits_of(), rate=1e9)


def test_a_path_without_motion_and_positions_beyond_limits_are_refused():
    with pytest.raises(KinematicsError, match="two different waypoints"):
        retime(np.zeros((3, JOINTS)), limits_of())
    narrow = replace(limits_of(), upper=np.full(JOINTS, 1.0))
    with pytest.raises(KinematicsError, match=r"waypoint 2: 1\.5 of joint `a` is beyond"):
        retime(np.array([[0.0] * JOINTS, [1.5] * JOINTS]), narrow)
    overshooting = np.zeros((4, JOINTS))
    overshooting[:, 0] = [-1.0, 0.99, 1.0, 0.0]
    with pytest.raises(KinematicsError, match=r"between waypoints 3 and 4: it reaches 1\.\d+; add a waypoint"):
        retime(overshooting, narrow)
