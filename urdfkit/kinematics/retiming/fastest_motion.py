"""The fastest motion along a path of joints within their limits.

The path is the natural cubic spline through the waypoints, a straight line between two. toppra finds the fastest
progress s(t) along it within limits of velocity and acceleration [Pham and Pham, A New Approach to Time-Optimal Path
Parameterization Based on Reachability Analysis, 2018]. Where jerk is limited too, ruckig finds the fastest progress on
a straight line [Berscheid and Kröger, Jerk-limited Real-time Trajectory Generation with Arbitrary Target States, 2021];
on a spline, toppra's progress is averaged over a moving window: the motion stays on the path, and its acceleration
becomes continuous. The window with the shortest motion is taken. At last the motion is slowed down evenly until every
sample is within the limits.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from urdfkit.errors import KinematicsError, MissingDependencyError
from urdfkit.kinematics.retiming.motion_limits import MotionLimits
from urdfkit.linear_algebra import Array

SAMPLES = 500
"""Samples per segment of a path in which a window is judged; the final check takes `FINE` times as many."""
FINE = 10
HEADROOM = 1e-6
"""Part by which a motion lasts longer than its samples demand, for the times between them."""
GRID = 100
"""Points per segment of the path in toppra's grid."""
WINDOWS = np.geomspace(0.002, 2.0, 60)
"""Windows that are tried, over the duration of toppra's motion."""
MOST = 10_000_000
"""Samples of a motion at most."""
NO_MOTION = "no motion along the path stays within the limits; check for waypoints that are very close to each other"
TOLERANCE = 1e-9
"""Excess of a position over its limit that is rounding [rad] or [m]."""


@dataclass(frozen=True)
class TimedPath:
    """A timed motion of joints, from rest to rest.

    Attributes:
        joints: names of the joints.
        time: [s], from 0; shape (N,).
        position: [rad] or [m]; shape (N, n).
        velocity: [rad/s] or [m/s]; shape (N, n).
        acceleration: [rad/s²] or [m/s²]; shape (N, n).
        waypoint_times: when the motion is at each waypoint [s].
    """

    joints: tuple[str, ...]
    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    waypoint_times: Array

    @property
    def duration(self) -> float:
        """Time from start to end [s]."""
        return float(self.time[-1])


_Progress = Callable[[Array], tuple[Array, Array, Array, Array]]
"""Times → s and its first three derivatives."""


def retime(waypoints: ArrayLike, limits: MotionLimits, *, rate: float = 100.0) -> TimedPath:
    """Return the fastest motion through waypoints, from rest to rest.

    Args:
        waypoints: configurations [rad] or [m]; shape (N, n), the joints as in `limits`. Repeated ones count once.
        limits: limits of the joints.
        rate: samples per second; the end is a sample too [1/s].

    Raises:
        KinematicsError: fewer than two different waypoints, or a position beyond its limits, also between waypoints.
        MissingDependencyError: toppra or ruckig is not installed.

    Examples:
        >>> import urdfkit
        >>> from urdfkit.kinematics.retiming import motion_limits
        >>> from urdfkit.kinematics import retime
        >>> joints = ["shoulder_pan_joint", "elbow_pitch_joint"]
        >>> limits = motion_limits(urdfkit.load("seven_dof_arm"), joints, acceleration={"": 3.0})
        >>> motion = retime([[0.0, 0.0], [0.8, -0.5], [-0.6, 0.3]], limits)
        >>> motion.position[-1].round(6)
        array([-0.6,  0.3])
    """
    points = np.asarray(waypoints, float)
    _check_waypoints(points, limits)
    changes = np.any(np.diff(points, axis=0) != 0.0, axis=1)
    index = np.concatenate([[0], np.cumsum(changes)])
    points = points[np.concatenate([[True], changes])]
    if len(points) < 2:
        raise KinematicsError("a path needs at least two different waypoints")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of the compilation of toppra's source, where it has no bytecode yet
            import toppra
    except ImportError:
        raise MissingDependencyError("retiming needs toppra: pip install 'urdfkit[time]'") from None
    # Progress is the length of the way, each joint in parts of its velocity limit: the spline then bends little.
    knots = np.concatenate([[0.0], np.cumsum(np.max(np.abs(np.diff(points, axis=0)) / limits.velocity, axis=1))])
    path = toppra.SplineInterpolator(knots, points, bc_type="natural")
    _check_between(path, knots, limits)
    if limits.jerk is not None and len(points) == 2:
        progress, duration = _straight(path, knots[-1], limits)
    else:
        profile, duration = _fastest(toppra, path, knots, limits)
        progress = profile
        if limits.jerk is not None:
            progress, duration = _smooth(path, profile, duration, limits)
    dense = np.linspace(0.0, duration, FINE * SAMPLES * len(points))
    slowing = _excess(path, progress, dense, limits)
    end = duration * slowing
    if end * rate > MOST:
        raise KinematicsError(f"{end:.4g} s at {rate:g} samples per second exceed {MOST:.0e} samples; use a lower rate")
    time = np.append(np.arange(0.0, end - 1e-9 * end, 1.0 / rate), end)
    position, velocity, acceleration, _ = _motion(path, progress, time / slowing)
    passed = np.interp(knots, progress(dense)[0], dense) * slowing
    return TimedPath(limits.joints, time, position, velocity / slowing, acceleration / slowing**2, passed[index])


def _check_waypoints(waypoints: Array, limits: MotionLimits) -> None:
    beyond = (waypoints < limits.lower - TOLERANCE) | (waypoints > limits.upper + TOLERANCE)
    if beyond.any():
        k, j = np.argwhere(beyond)[0]
        raise KinematicsError(
            f"waypoint {k + 1}: {waypoints[k, j]:g} of joint `{limits.joints[j]}` is beyond its limits "
            f"{limits.lower[j]:g} … {limits.upper[j]:g}"
        )


def _check_between(path: Any, knots: Array, limits: MotionLimits) -> None:
    """Refuse a spline that leaves the limits between waypoints within them."""
    places = np.unique(np.concatenate([np.linspace(0.0, knots[-1], FINE * SAMPLES * len(knots)), knots]))
    positions = path(places)
    excess = np.maximum(limits.lower - positions, positions - limits.upper)
    k, j = np.unravel_index(int(np.argmax(excess)), excess.shape)
    if excess[k, j] > TOLERANCE:
        segment = min(int(np.searchsorted(knots, places[k], side="right")), len(knots) - 1)
        raise KinematicsError(
            f"the curve through the waypoints leaves the limits of joint `{limits.joints[j]}`, "
            f"{limits.lower[j]:g} … {limits.upper[j]:g}, between waypoints {segment} and {segment + 1}: it reaches "
            f"{positions[k, j]:g}; add a waypoint between them"
        )


def _fastest(toppra: Any, path: Any, knots: Array, limits: MotionLimits) -> tuple[_Profile, float]:
    """Return the fastest progress within the limits of velocity and acceleration, and its duration."""
    toppra.setup_logging("ERROR")
    bounds = [np.stack([-values, values], axis=1) for values in (limits.velocity, limits.acceleration)]
    grid = np.unique(np.concatenate([np.linspace(a, b, GRID) for a, b in pairwise(knots)]))
    scheme = toppra.constraint.DiscretizationType.Interpolation
    constraints = [
        toppra.constraint.JointVelocityConstraint(bounds[0]),
        toppra.constraint.JointAccelerationConstraint(bounds[1], discretization_scheme=scheme),
    ]
    solver = toppra.algorithm.TOPPRA(constraints, path, gridpoints=grid, solver_wrapper="seidel")
    _, speeds, _ = solver.compute_parameterization(0.0, 0.0)
    if speeds is None or not np.all(np.isfinite(speeds)):
        raise KinematicsError(NO_MOTION)
    spans = 2.0 * np.diff(grid) / np.maximum(speeds[:-1] + speeds[1:], 1e-12)
    times = np.concatenate([[0.0], np.cumsum(spans)])
    profile = _Profile(times, grid, speeds, np.append(np.diff(speeds) / spans, 0.0))
    return profile, float(times[-1])


class _Profile:
    """Progress with a constant acceleration between times, at rest before the first and after the last.

    Args:
        times: [s]; shape (N,), like the others.
        places: s at these times.
        speeds: its first derivative.
        rates: its second derivative from each time to the next; 0 for the last.
    """

    def __init__(self, times: Array, places: Array, speeds: Array, rates: Array) -> None:
        self._times, self._places, self._speeds, self._rates = times, places, speeds, rates
        spans = np.diff(times)
        areas = (places[:-1] + (speeds[:-1] / 2.0 + rates[:-1] / 6.0 * spans) * spans) * spans
        self._areas = np.concatenate([[0.0], np.cumsum(areas)])

    def __call__(self, time: Array) -> tuple[Array, Array, Array, Array]:
        k, passed = self._segment(time)
        moves = (time >= 0.0) & (time <= self._times[-1])
        speed = np.where(moves, self._speeds[k] + self._rates[k] * passed, 0.0)
        place = self._places[k] + (self._speeds[k] + 0.5 * self._rates[k] * passed) * passed
        return place, speed, np.where(moves, self._rates[k], 0.0), np.zeros_like(speed)

    def integral(self, time: Array) -> Array:
        """Return the integral of the progress from 0."""
        k, passed = self._segment(time)
        area = (self._places[k] + (self._speeds[k] / 2.0 + self._rates[k] / 6.0 * passed) * passed) * passed
        beyond = np.maximum(time - self._times[-1], 0.0) * self._places[-1]
        return np.asarray(self._areas[k] + area + beyond)

    def _segment(self, time: Array) -> tuple[NDArray[np.intp], Array]:
        inside = np.clip(time, 0.0, self._times[-1])
        k = np.searchsorted(self._times, inside, side="right") - 1
        k = np.minimum(k, len(self._times) - 2)
        return k, inside - self._times[k]


def _straight(path: Any, length: float, limits: MotionLimits) -> tuple[_Progress, float]:
    """Return the fastest progress on a straight line within the limits of jerk too, and its duration."""
    try:
        from ruckig import InputParameter, Result, Ruckig
        from ruckig import Trajectory as Profile
    except ImportError:
        raise MissingDependencyError("retiming with jerk limits needs ruckig: pip install 'urdfkit[time]'") from None
    assert limits.jerk is not None
    slope = np.maximum(np.abs(path(0.0, 1)), 1e-300)
    wanted = InputParameter(1)
    wanted.current_position, wanted.target_position = [0.0], [length]
    wanted.max_velocity = [float(np.min(limits.velocity / slope))]
    wanted.max_acceleration = [float(np.min(limits.acceleration / slope))]
    wanted.max_jerk = [float(np.min(limits.jerk / slope))]
    profile = Profile(1)
    if Ruckig(1).calculate(wanted, profile) not in (Result.Working, Result.Finished):
        raise KinematicsError(NO_MOTION)

    def progress(time: Array) -> tuple[Array, Array, Array, Array]:
        states = np.array([[part[0] for part in profile.at_time(t)] for t in np.clip(time, 0.0, profile.duration)])
        place, speed, rate = states.T
        jerk = np.gradient(rate, time) if len(time) > 1 else np.zeros_like(rate)
        return place, speed, rate, np.clip(jerk, -wanted.max_jerk[0], wanted.max_jerk[0])

    return progress, float(profile.duration)


def _smooth(path: Any, profile: _Profile, duration: float, limits: MotionLimits) -> tuple[_Progress, float]:
    """Return the progress averaged over the moving window with the shortest motion within all limits."""
    samples = SAMPLES * len(path.waypoints[0])
    end = profile(np.array([duration]))[0]

    def averaged(window: float) -> _Progress:
        def smooth(time: Array) -> tuple[Array, Array, Array, Array]:
            now, before = profile(time), profile(time - window)
            place = np.clip((profile.integral(time) - profile.integral(time - window)) / window, 0.0, end)
            return place, *((now[i] - before[i]) / window for i in range(3))  # type: ignore[return-value]

        return smooth

    def length(window: float) -> float:
        smooth = averaged(window)
        return (duration + window) * _excess(path, smooth, np.linspace(0.0, duration + window, samples), limits)

    best = min((float(part) * duration for part in WINDOWS), key=length)
    return averaged(best), duration + best


def _motion(path: Any, progress: _Progress, time: Array) -> tuple[Array, Array, Array, Array]:
    """Return positions and their first three derivatives at times; each of the shape (N, n)."""
    s, v, a, j = (values[:, None] for values in progress(time))
    s = s[:, 0]
    first, second = path(s, 1), path(s, 2)
    third = path.cspl(s, 3)
    return path(s), first * v, first * a + second * v**2, first * j + 3.0 * second * v * a + third * v**3


def _excess(path: Any, progress: _Progress, time: Array, limits: MotionLimits) -> float:
    """Return the factor by which the motion must last longer to be within all limits at these times; 1 at least."""
    _, velocity, acceleration, jerk = _motion(path, progress, time)
    factors = [np.max(np.abs(velocity) / limits.velocity), np.sqrt(np.max(np.abs(acceleration) / limits.acceleration))]
    if limits.jerk is not None:
        factors.append(np.cbrt(np.max(np.abs(jerk) / limits.jerk)))
    return max(1.0, *map(float, factors)) * (1.0 + HEADROOM)
