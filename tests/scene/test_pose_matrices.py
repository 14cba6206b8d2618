from __future__ import annotations

import numpy as np
import pinocchio as pin
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description.urdf.robot import Pose
from urdfkit.scene.pose_matrices import pose_matrices, pose_matrix

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
