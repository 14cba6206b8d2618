"""Inverse kinematics: success and accuracy by Pinocchio, limits, turns, order and threads."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
import pytest

from tests.kinematics.arms import PANDA, UR5, UR5_LIMITED, Reference, errors, random_configurations, robot_or_skip
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Chain

ARMS = {
    "panda": PANDA,
    "ur5": UR5,
    "ur5_limited": UR5_LIMITED,
}


@pytest.mark.parametrize("name", ARMS)
def test_random_reachable_poses_are_reached_within_limits(name: str) -> None:
    file, base, tip = ARMS[name]
    chain = Chain(robot_or_skip(file), base, tip)
    targets = chain.forward(random_configurations(chain, 1000, 3))
    found = chain.solve(targets)
    distance, angle = errors(Reference(chain).poses(found.q), targets)
    assert np.count_nonzero(found.reached) >= 999
    assert (distance[found.reached] <= 1e-3).all()
    assert (angle[found.reached] <= 1.745e-3).all()
    assert (found.q >= chain.lower).all()
    assert (found.q <= chain.upper).all()
    np.testing.assert_allclose(found.position_error, distance, rtol=0, atol=1e-12)
    np.testing.assert_allclose(found.rotation_error, angle, rtol=0, atol=1e-7)


@pytest.mark.parametrize("number", [1, 2, 3])
def test_threads_and_order_change_no_bit(arm: Robot, number: int) -> None:
    chain = Chain(arm, "world", "finger_a")
    targets = chain.forward(random_configurations(chain, 500, number))
    targets[:, :3, 3] += np.random.default_rng(number).normal(scale=0.02, size=(500, 3))  # some out of reach
    one = chain.solve(targets, threads=1)
    order = np.random.default_rng(number).permutation(500)
    for threads, at in ((4, np.arange(500)), (3, order)):
        found = chain.solve(targets[at], threads=threads)
        for field in ("q", "reached", "position_error", "rotation_error", "restarts"):
            assert getattr(found, field).tobytes() == getattr(one, field)[at].tobytes()
    assert chain.solve(targets[7]).q.tobytes() == one.q[7].tobytes()


def test_poses_and_matrices_are_the_same_target(arm: Robot) -> None:
    chain = Chain(arm, "world", "finger_a")
    q = np.array([0.5, 0.2, 0.7, 0.02])
    matrix = chain.forward(q)
    x, y, z, w = pin.SE3ToXYZQUAT(pin.SE3(matrix))[3:]
    pose = [*matrix[:3, 3], 3.0 * x, 3.0 * y, 3.0 * z, 3.0 * w]  # a quaternion of any length
    for target in (matrix, pose):
        np.testing.assert_allclose(chain.solve(target, q + 0.01).q, q, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "target",
    [
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [np.nan, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        [np.inf, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        np.diag([1.0, 1.0, -1.0, 1.0]),
        np.diag([1.0, 1.0, 1.01, 1.0]),
    ],
)
def test_targets_that_are_no_pose_are_refused(arm: Robot, target: object) -> None:
    chain = Chain(arm, "world", "finger_a")
    with pytest.raises(KinematicsError, match=r"^target is no pose"):
        chain.solve(target)
    good = np.eye(4) if np.shape(target) == (4, 4) else [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    with pytest.raises(KinematicsError, match=r"^target 1 is no pose"):
        chain.solve([good, target, target])


def test_continuous_joints_stay_on_the_turn_of_the_seed(arm: Robot) -> None:
    chain = Chain(arm, "world", "finger_a")
    targets = chain.forward(random_configurations(chain, 50, 5))
    for turns in (-3, 0, 20):
        seeds = np.array([2.0 * np.pi * turns, 0.0, 0.0, 0.0])
        found = chain.solve(targets, seeds)
        assert found.reached.all()
        assert (np.abs(found.q[:, 0] - seeds[0]) <= np.pi + 1e-12).all()


def test_seeds_out_of_limits_are_moved_into_them(arm: Robot) -> None:
    chain = Chain(arm, "world", "finger_a")
    target = chain.forward(np.array([0.3, 0.2, 1.0, 0.02]))
    found = chain.solve(target, [0.0, 17.0, -90.0, 5.0])
    assert found.reached
    assert (found.q >= chain.lower).all()
    assert (found.q <= chain.upper).all()


def test_position_only(robot_of: Callable[[str], Robot], arm: Robot) -> None:
    chain = Chain(arm, "world", "finger_a")
    targets = chain.forward(random_configurations(chain, 100, 7))
    other = targets.copy()
    other[:, :3, :3] = np.diag([-1.0, 1.0, -1.0])
    found = chain.solve(other, position_only=True)
    assert found.reached.all()
    distance, angle = errors(Reference(chain).poses(found.q), other)
    assert (distance <= 1e-3).all()
    np.testing.assert_allclose(found.rotation_error, angle, rtol=0, atol=1e-7)
    assert found.rotation_error.max() > 1.0


def test_an_unknown_preference_is_refused(arm: Robot) -> None:
    with pytest.raises(KinematicsError, match="unknown preference `nearst`; did you mean `nearest`"):
        Chain(arm, "world", "camera").solve(np.eye(4), prefer="nearst")
