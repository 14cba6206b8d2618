"""Frames and extents against Pinocchio's and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfkit.description import load
from urdfkit.description.urdf.geometry import box_around, rotation_of, unit
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Pose, Sphere
from urdfkit.lint.facts.gazebo.drive_wheels import same_turn
from urdfkit.lint.model.placement import Extent, Frame

angles = st.tuples(*[st.floats(-7, 7)] * 3)
points = st.tuples(*[st.floats(-2, 2)] * 3)
sizes = st.floats(0.01, 2)
shapes = st.one_of(
    st.builds(Box, st.tuples(sizes, sizes, sizes)),
    st.builds(Cylinder, sizes, sizes),
    st.builds(Sphere, sizes),
    st.builds(Capsule, sizes, sizes),
)


@given(angles, points, angles, points)
def test_frames_compose_as_pinocchio_has_them(rpy, xyz, turn, offset):
    ours = Frame().moved(Pose(xyz, rpy)).moved(Pose(offset, turn))
    theirs = pin.SE3(pin.rpy.rpyToMatrix(*rpy), np.array(xyz)) * pin.SE3(pin.rpy.rpyToMatrix(*turn), np.array(offset))
    np.testing.assert_allclose(ours.rotation, theirs.rotation, atol=1e-12)
    np.testing.assert_allclose(ours.translation, theirs.translation, atol=1e-12)


def surface(shape) -> np.ndarray:
    """Points of a shape, its outermost ones among them, about its middle."""
    turn, rise = np.meshgrid(np.linspace(0, 2 * np.pi, 361), np.linspace(-np.pi / 2, np.pi / 2, 181))
    ball = np.stack([np.cos(turn) * np.cos(rise), np.sin(turn) * np.cos(rise), np.sin(rise)], axis=-1).reshape(-1, 3)
    if isinstance(shape, Box):
        return np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * shape.size
    if isinstance(shape, Sphere):
        return ball * shape.radius
    ends = np.array([[0, 0, shape.length / 2], [0, 0, -shape.length / 2]])
    if isinstance(shape, Capsule):
        return (ball * shape.radius + ends[:, None]).reshape(-1, 3)
    ring = np.stack([np.cos(turn[0]), np.sin(turn[0]), 0 * turn[0]], axis=-1) * shape.radius
    return (ring + ends[:, None]).reshape(-1, 3)


@pytest.mark.slow
@settings(max_examples=40)
@given(shapes, points, angles, points)
def test_boxes_and_reach_are_those_of_the_surface(shape, xyz, rpy, point):
    pose = Pose(xyz, rpy)
    there = surface(shape) @ np.array(rotation_of(rpy)).T + xyz
    low, high = box_around(shape, pose)
    np.testing.assert_allclose(low, there.min(axis=0), atol=2e-4)
    np.testing.assert_allclose(high, there.max(axis=0), atol=2e-4)
    filled = Extent(low, high, ((shape, pose),), ())
    assert filled.radius(point) == pytest.approx(np.linalg.norm(there - point, axis=1).max(), abs=2e-4)


def test_outside_is_the_distance_to_thebox_around():
    filled = Extent((-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), (), ())
    assert filled.outside((0.5, -1.0, 0.0)) == 0
    assert filled.outside((4.0, 5.0, 1.0)) == pytest.approx(5.0)
    assert filled.diagonal == pytest.approx(math.sqrt(12))


def test_links_are_where_pinocchio_puts_them(tmp_path):
    from urdfkit.lint.model.placement import frames

    path = tmp_path / "r.urdf"
    path.write_text(
        """<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
<joint name="j" type="fixed"><origin xyz="1 2 3" rpy="0.1 0.2 0.3"/><parent link="a"/><child link="b"/></joint>
<joint name="k" type="fixed"><origin xyz="0 0 1" rpy="1 0 0"/><parent link="b"/><child link="c"/></joint></robot>"""
    )
    ours = frames(load(path))["c"]
    model = pin.buildModelFromUrdf(str(path))
    data = model.createData()
    pin.framesForwardKinematics(model, data, pin.neutral(model))
    theirs = data.oMf[model.getFrameId("c")]
    np.testing.assert_allclose(ours.translation, theirs.translation, atol=1e-12)
    np.testing.assert_allclose(ours.rotation, theirs.rotation, atol=1e-12)


def test_a_vector_without_length_has_no_direction():
    assert unit((0.0, 0.0, 0.0)) is None
    assert unit((0.0, 3.0, 4.0)) == pytest.approx((0.0, 0.6, 0.8))


def test_turns_are_compared_as_rotations():
    assert same_turn((0.0, 0.0, 0.0), (0.0, 0.0, 2 * math.pi)) == pytest.approx(0, abs=1e-12)
    assert same_turn((-1.57, 0.0, -1.57), (-math.pi / 2, 0.0, -math.pi / 2)) < 2e-3
