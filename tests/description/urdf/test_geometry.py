"""Rotations as angles, matrices and quaternions, and the composition of poses."""

from __future__ import annotations

from itertools import product
from math import cos, pi, sin

import numpy as np
import pytest

from urdfkit.description.urdf.geometry import (
    between,
    box_around_all,
    compose,
    difference,
    inverse,
    rotate,
    rotation_of,
    rpy_of,
    rpy_of_quaternion,
    second_moments,
)
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Pose, Sphere

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


def test_a_box_around_boxes_has_their_least_and_greatest_coordinates() -> None:
    boxes = [((1.0, 5.0, -3.0), (2.0, 6.0, -2.0)), ((0.0, 7.0, -4.0), (1.5, 8.0, 9.0))]
    assert box_around_all(boxes) == ((0.0, 5.0, -4.0), (2.0, 8.0, 9.0))


def test_the_difference_of_poses_is_the_larger_of_distance_and_rotation() -> None:
    assert difference(Pose((1.0, 2.0, 3.0)), Pose((1.0, 2.5, 2.0))) == 1.0
    assert difference(Pose(), Pose((0.1, 0.0, 0.0), (0.0, 0.0, pi / 2))) == pytest.approx(1.0)


@pytest.mark.parametrize(
    "shape",
    [Box((0.6, 0.4, 0.2)), Sphere(0.3), Cylinder(radius=0.2, length=0.7), Capsule(radius=0.2, length=0.7)],
    ids=lambda shape: type(shape).__name__,
)
def test_second_moments_are_those_of_slices(shape: Geometry) -> None:
    unit = (np.arange(20_000) + 0.5) / 10_000 - 1.0
    if isinstance(shape, Box):
        x, y, height = shape.size
        z, weight = unit * height / 2, np.ones_like(unit)
        across = np.full_like(z, x**2 / 12), np.full_like(z, y**2 / 12)
    else:
        assert isinstance(shape, (Sphere, Cylinder, Capsule))
        half = 0.0 if isinstance(shape, Sphere) else shape.length / 2
        z = unit * (half if isinstance(shape, Cylinder) else half + shape.radius)
        weight = shape.radius**2 - np.maximum(np.abs(z) - half, 0.0) ** 2  # squares of the radii of slices
        across = weight / 4, weight / 4
    expected = [np.average(values, weights=weight) for values in (*across, z**2)]
    assert second_moments(shape) == pytest.approx(expected, rel=1e-6)  # of 20,000 slices
