"""Placements without numpy against matrices and the rotations of Pinocchio."""

from __future__ import annotations

import numpy as np
import pinocchio
import pytest

from urdfkit.description.urdf.robot import Pose
from urdfkit.kinematics.serial.rigid_placement import (
    Placement,
    compose,
    invert,
    placement_of,
    placement_of_quaternion,
    rotation_to,
    turned,
)

RANDOM = np.random.default_rng(0)


def matrix(placement: Placement) -> np.ndarray:
    """Return a placement as a homogeneous matrix."""
    rotation, place = np.reshape(placement[:9], (3, 3)), np.reshape(placement[9:], (3, 1))
    return np.vstack([np.hstack([rotation, place]), [0, 0, 0, 1]])


def random_placement() -> Placement:
    return placement_of_quaternion(RANDOM.normal(size=3), RANDOM.normal(size=4))


def test_quaternions_need_not_be_normalised() -> None:
    for quaternion in RANDOM.normal(size=(9, 4)):
        expected = pinocchio.Quaternion(quaternion / np.linalg.norm(quaternion)).toRotationMatrix()
        assert matrix(placement_of_quaternion((0.0, 0.0, 0.0), quaternion))[:3, :3] == pytest.approx(expected)


def test_products_and_inverses() -> None:
    one, other = random_placement(), random_placement()
    assert matrix(compose(one, other)) == pytest.approx(matrix(one) @ matrix(other))
    assert matrix(invert(one)) == pytest.approx(np.linalg.inv(matrix(one)))


def test_placements_equal_those_of_pinocchio() -> None:
    rpy, xyz = (0.3, -0.7, 2.0), (1.0, 2.0, 3.0)
    placed = matrix(placement_of(Pose(xyz, rpy)))
    assert placed[:3, :3] == pytest.approx(pinocchio.rpy.rpyToMatrix(*rpy))
    assert placed[:3, 3] == pytest.approx(xyz)
    expected = pinocchio.SE3(pinocchio.rpy.rpyToMatrix(0, 0, 0.4), np.array([0, 0, 0.5]))
    assert matrix(turned(0.4, 0.5)) == pytest.approx(expected.homogeneous)


@pytest.mark.parametrize("axis", [(0, 0, 1), (0, 0, -1), (1, 0, 0), (0.6, 0, 0.8), (0.48, -0.6, -0.64)])
def test_the_smallest_rotation_to_an_axis(axis: tuple[float, float, float]) -> None:
    rotation = matrix(rotation_to(axis))[:3, :3]
    assert rotation @ (0, 0, 1) == pytest.approx(axis)
    assert rotation @ rotation.T == pytest.approx(np.eye(3))
    assert np.linalg.norm(pinocchio.log3(rotation)) == pytest.approx(np.arccos(axis[2]))
