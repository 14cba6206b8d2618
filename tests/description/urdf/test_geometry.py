"""Rotations as angles, matrices and quaternions, and the composition of poses."""

from __future__ import annotations

from itertools import product
from math import cos, pi, sin

import pytest

from urdfkit.description.urdf.geometry import (
    between,
    compose,
    difference,
    inverse,
    rotate,
    rotation_of,
    rpy_of,
    rpy_of_quaternion,
)
from urdfkit.description.urdf.robot import Pose

ANGLES = [
    (roll, pitch, yaw)
    for roll, pitch, yaw in product((-2.5, -0.3, 0.0, 1.2), (-pi / 2, -0.8, 0.0, 1.4, pi / 2), (-3.0, 0.0, 0.7))
]


def quaternion(roll: float, pitch: float, yaw: float) -> tuple[float, float, float, float]:
    """Return x, y, z, w: the product of the rotations about z, y and x, by half angles."""
    (sr, cr), (sp, cp), (sy, cy) = ((sin(angle / 2), cos(angle / 2)) for angle in (roll, pitch, yaw))
    return (
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    )


def entries(rpy: tuple[float, float, float]) -> list[float]:
    return [entry for row in rotation_of(rpy) for entry in row]


@pytest.mark.parametrize("rpy", ANGLES)
def test_angles_are_those_of_a_matrix_and_of_a_quaternion(rpy: tuple[float, float, float]) -> None:
    """At a pitch of a right angle, rounding of the sine makes an error of the square root of 1e-16."""
    assert entries(rpy_of(rotation_of(rpy))) == pytest.approx(entries(rpy), abs=1e-7)
    for length in (1.0, 3.0):
        again = rpy_of_quaternion(*(length * part for part in quaternion(*rpy)))  # type: ignore[call-arg]
        assert entries(again) == pytest.approx(entries(rpy), abs=1e-7)


def test_the_matrix_is_the_product_of_turns_about_fixed_axes() -> None:
    assert rotate(rotation_of((pi / 2, 0.0, 0.0)), (0.0, 1.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0))
    assert rotate(rotation_of((0.0, pi / 2, 0.0)), (0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0))
    assert rotate(rotation_of((0.0, 0.0, pi / 2)), (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))
    assert rotate(rotation_of((pi / 2, 0.0, pi / 2)), (0.0, 1.0, 0.0)) == pytest.approx((0.0, 0.0, 1.0))
    assert rotate(rotation_of((pi / 2, 0.0, pi / 2)), (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))


def test_a_pose_is_the_outer_one_and_the_difference() -> None:
    outer, inner = Pose((1.0, 2.0, 3.0), (0.1, 0.2, 0.3)), Pose((-1.0, 0.5, 2.0), (0.4, -0.5, 0.6))
    both = compose(outer, inner)
    moved = rotate(rotation_of(outer.rpy), inner.xyz)
    assert both.xyz == pytest.approx([a + b for a, b in zip(outer.xyz, moved, strict=True)])
    again = between(outer, both)
    assert again.xyz == pytest.approx(inner.xyz)
    assert again.rpy == pytest.approx(inner.rpy)
    assert difference(compose(outer, inverse(outer)), Pose()) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("pose", [Pose((1.0, 2.0, 3.0), (0.1, 0.2, 0.3)), Pose((1.0, 2.0, 3.0)), Pose()])
def test_the_identity_changes_no_digit_of_a_pose(pose: Pose) -> None:
    assert compose(pose, Pose()) == compose(Pose(), pose) == pose
    assert compose(Pose((1.0, 0.0, 0.0)), pose) == Pose((pose.xyz[0] + 1.0, *pose.xyz[1:]), pose.rpy)
    assert compose(pose, Pose((1.0, 0.0, 0.0))).rpy == pose.rpy


def test_the_difference_of_poses_is_the_larger_of_distance_and_rotation() -> None:
    assert difference(Pose((1.0, 2.0, 3.0)), Pose((1.0, 2.5, 2.0))) == 1.0
    assert difference(Pose(), Pose((0.1, 0.0, 0.0), (0.0, 0.0, pi / 2))) == pytest.approx(1.0)
