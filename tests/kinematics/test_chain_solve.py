"""Inverse kinematics: success and accuracy by Pinocchio, limits, turns, order and threads."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from tests.kinematics.arms import (
    FR3,
    PANDA,
    ROMEO,
    UR5,
    UR5_LIMITED,
    Reference,
    errors,
    made_arm,
    random_configurations,
    robot_or_skip,
)
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Chain

ARMS = {
    "panda": PANDA,
    "ur5": UR5,
    "ur5_limited": UR5_LIMITED,
    "fr3": FR3,
    "romeo": ROMEO,
    "bundled": ("seven_dof_arm", "world", "grasping_frame"),
    "new robot with 6 joints": 6,
    "new robot with 7 joints": 7,
}


@pytest.mark.parametrize("name", ARMS)
def test_random_reachable_poses_are_reached_within_limits(name: str, tmp_path: Path) -> None:
    arm = ARMS[name]
    file, base, tip = made_arm(tmp_path, arm) if isinstance(arm, int) else arm
    chain = Chain(robot_or_skip(file) if isinstance(file, Path) else file, base, tip)
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


@pytest.mark.slow
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
        [1e200, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0],
        np.diag([1.0, 1.0, -1.0, 1.0]),
        np.diag([1.0, 1.0, 1.01, 1.0]),
    ],
)
def test_targets_that_are_no_pose_are_refused(arm: Robot, target: object) -> None:
    chain = Chain(arm, "world", "finger_a")
    with pytest.raises(KinematicsError, match=r"^target is not a pose"):
        chain.solve(target)
    good = np.eye(4) if np.shape(target) == (4, 4) else [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]
    with pytest.raises(KinematicsError, match=r"^target 1 is not a pose"):
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


@pytest.mark.slow
def test_unreachable_targets_get_the_nearest_configuration(arm: Robot) -> None:
    chain = Chain(arm, "world", "finger_a")
    targets = chain.forward(random_configurations(chain, 8, 2))
    targets[:, :3, 3] *= np.random.default_rng(1).uniform(1.5, 3.0, (8, 1))
    nearest = np.array([distance_by_pinocchio(chain, target[:3, 3], 100) for target in targets])
    for position_only in (False, True):
        found = chain.solve(targets, position_only=position_only)
        assert np.count_nonzero(found.reached) <= 2
        assert (found.position_error <= nearest + 1e-4).all()
        distance, _ = errors(Reference(chain).poses(found.q), targets)
        np.testing.assert_allclose(found.position_error, distance, rtol=0, atol=1e-12)


def distance_by_pinocchio(chain: Chain, target: np.ndarray, restarts: int) -> float:
    """Return the smallest distance that damped steps of Gauss and Newton find from random configurations."""
    reference = Reference(chain)
    kinematics, model = reference.kinematics, reference.kinematics.model
    frame, columns = kinematics.frame(chain.tip), [kinematics.velocity_index(name) for name in chain.joint_names]
    best = np.inf
    for start in random_configurations(chain, restarts, 4):
        q, damping, error = start, 1e-2, target - reference.pose(start)[:3, 3]
        for _ in range(40):
            configuration = kinematics.configuration(dict(zip(chain.joint_names, q.tolist(), strict=True)))
            every = pin.computeFrameJacobian(model, kinematics.data, configuration, frame, pin.LOCAL_WORLD_ALIGNED)
            jacobian = every[:3, columns]
            outward = ((q <= chain.lower) & (jacobian.T @ error < 0)) | ((q >= chain.upper) & (jacobian.T @ error > 0))
            jacobian = np.where(outward, 0.0, jacobian)
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + damping * np.eye(3), error)
            tried = np.clip(q + step, chain.lower, chain.upper)
            left = target - reference.pose(tried)[:3, 3]
            if left @ left < error @ error:
                q, error, damping = tried, left, 0.3 * damping
            else:
                damping *= 4.0
        best = min(best, float(np.linalg.norm(error)))
    return best


def test_a_preference_improves_the_solution() -> None:
    file, base, tip = PANDA
    chain = Chain(robot_or_skip(file), base, tip)
    targets = chain.forward(random_configurations(chain, 100, 9))
    seeds = random_configurations(chain, 100, 10)
    found = {name: chain.solve(targets, seeds, prefer=name) for name in ("first", "nearest", "manipulability")}
    assert all(each.reached.all() for each in found.values())
    away = {name: np.linalg.norm(each.q - seeds, axis=1) for name, each in found.items()}
    assert (away["nearest"] <= away["first"] + 1e-9).all()
    assert away["nearest"].mean() < 0.9 * away["first"].mean()
    measures = {name: chain.manipulability(each.q) for name, each in found.items()}
    assert (measures["manipulability"] >= measures["first"] - 1e-9).all()
    assert measures["manipulability"].mean() > 1.1 * measures["first"].mean()
    jacobians = chain.jacobian(found["first"].q)
    expected = np.sqrt(np.linalg.det(jacobians @ jacobians.transpose(0, 2, 1)))
    np.testing.assert_allclose(measures["first"], expected, rtol=0, atol=1e-12)


def test_all_solutions_of_a_six_joint_arm_with_all_whole_turns() -> None:
    file, base, tip = UR5
    chain = Chain(robot_or_skip(file), base, tip)
    q = np.array([0.4, -1.2, 1.1, -0.6, 0.8, 0.3])
    target = chain.forward(q)
    found = chain.solve_all(target, q, most=5000)
    distance, angle = errors(Reference(chain).poses(found.q), np.broadcast_to(target, (len(found.q), 4, 4)))
    assert found.reached.all()
    assert (distance <= 1e-3).all()
    assert (angle <= 1.745e-3).all()
    assert ((found.q >= chain.lower) & (found.q <= chain.upper)).all()
    np.testing.assert_allclose(found.q[0], q, rtol=0, atol=1e-6)
    differences = np.linalg.norm(found.q - q, axis=1)
    assert (np.diff(differences) >= -1e-12).all()
    # Eight branches within a turn; all joints but the elbow have limits of two turns.
    within = np.unique(np.round(np.mod(found.q, 2.0 * np.pi), 3), axis=0)
    assert len(within) == 8
    assert len(found.q) == 8 * 2**5


@pytest.mark.parametrize("position_only", [False, True])
def test_singular_targets_and_targets_on_limits_are_reached(arm: Robot, position_only: bool) -> None:
    chain = Chain(arm, "world", "finger_a")
    ends = np.array([[0.2, 0.4, 2.0, 0.04], [0.2, -0.1, -1.5, 0.0], [1.0, 0.4, -1.5, 0.04], [0.0, 0.0, 0.0, 0.0]])
    assert chain.solve(chain.forward(ends), position_only=position_only).reached.all()
    for file, base, tip in (PANDA, UR5):
        larger = Chain(robot_or_skip(file), base, tip)
        straight = np.clip(np.zeros((1, len(larger.lower))), larger.lower, larger.upper)
        assert larger.solve(larger.forward(straight), position_only=position_only).reached.all()
        assert larger.solve(larger.forward(np.array([larger.lower, larger.upper]))).reached.all()
