from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.urdf.robot import Pose
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix, upright

angle = st.floats(-10, 10)
length = st.floats(-100, 100)


@given(rpy=st.tuples(angle, angle, angle), xyz=st.tuples(length, length, length))
def test_an_origin_is_what_pinocchio_makes_of_it(
    rpy: tuple[float, float, float], xyz: tuple[float, float, float]
) -> None:
    expected = pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array(xyz)).homogeneous
    np.testing.assert_allclose(pose_matrix(Pose(xyz, rpy)), expected, rtol=0, atol=1e-14)


@given(seed=st.integers(0, 2**32 - 1), scale=st.floats(0.1, 10))
def test_poses_are_what_pinocchio_makes_of_them(seed: int, scale: float) -> None:
    rng = np.random.default_rng(seed)
    placements = [pin.exp6(pin.Motion(rng.normal(size=6) * 3)) for _ in range(4)]
    poses = np.array([pin.SE3ToXYZQUAT(placement) for placement in placements])
    poses[:, 3:] *= scale  # a quaternion need not be a unit one
    expected = [placement.homogeneous for placement in placements]
    np.testing.assert_allclose(pose_matrices(poses), expected, rtol=0, atol=1e-14)


@given(angle, st.floats(0.0, 3.1415))
def test_a_plane_is_turned_by_the_smallest_rotation(heading: float, tilt: float) -> None:
    normal = np.array([np.sin(tilt) * np.cos(heading), np.sin(tilt) * np.sin(heading), np.cos(tilt)])
    expected = pin.exp3(tilt * np.array([-np.sin(heading), np.cos(heading), 0.0]))
    np.testing.assert_allclose(upright(normal), expected, rtol=0, atol=1e-11)


@pytest.mark.parametrize("normal", [(0.0, 0.0, -1.0), (1e-9, 0.0, -1.0), (3e-7, -4e-7, -1.0)])
def test_a_plane_that_looks_down_is_turned_by_half_a_turn(normal: tuple[float, float, float]) -> None:
    turn = upright(normal)
    assert turn[:, 2].tolist() == list(normal)
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(turn) == pytest.approx(1.0)


def test_a_plane_on_the_ground_is_not_turned() -> None:
    assert upright((0.0, 0.0, 1.0)).tolist() == np.eye(3).tolist()
