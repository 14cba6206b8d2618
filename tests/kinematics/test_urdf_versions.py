"""URDF 1.1 and 1.2 against the reader of Pinocchio, which is urdfdom 6."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pinocchio as pin
import pytest

from tests.kinematics.random_urdf import random_urdf
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import ModelError
from urdfkit.kinematics import Kinematics
from urdfkit.scene.scene_table import scene_of

TOLERANCE = 1e-9
ROBOTS = 200


@pytest.mark.slow
def test_random_robots_move_as_in_pinocchio(robot_of: Callable[[str], Robot]) -> None:
    worst = 0.0
    for seed in range(ROBOTS):
        xml = random_urdf(seed)
        kinematics = Kinematics(robot_of(xml))
        ours, theirs = kinematics.model, pin.buildModelFromXML(xml)
        assert [frame.name for frame in ours.frames] == [frame.name for frame in theirs.frames]
        rng = np.random.default_rng(seed)
        data, reference = ours.createData(), theirs.createData()
        for _ in range(3):
            q = pin.integrate(theirs, pin.neutral(theirs), rng.uniform(-2.0, 2.0, theirs.nv))
            v = rng.normal(size=theirs.nv)
            pin.framesForwardKinematics(ours, data, q)
            pin.framesForwardKinematics(theirs, reference, q)
            for one, other in zip(data.oMf, reference.oMf, strict=True):
                worst = max(worst, abs(one.homogeneous - other.homogeneous).max())
            if theirs.nv:
                M, bias = pin.crba(theirs, reference, q), pin.nonLinearEffects(theirs, reference, q, v)
                scale = max(1.0, abs(M).max(), abs(bias).max())
                worst = max(worst, abs(pin.crba(ours, data, q) - M).max() / scale)
                worst = max(worst, abs(pin.nonLinearEffects(ours, data, q, v) - bias).max() / scale)
        for name in ("lowerPositionLimit", "upperPositionLimit", "upperEffortLimit", "upperVelocityLimit"):
            np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name), err_msg=name)
    assert worst < TOLERANCE


@pytest.mark.parametrize("seed", range(5))
def test_capsules_are_placed_as_in_pinocchio(robot_of: Callable[[str], Robot], seed: int) -> None:
    xml = random_urdf(seed)
    model = pin.buildModelFromXML(xml)
    geometry = pin.buildGeomFromUrdfString(model, xml, pin.GeometryType.COLLISION)
    shapes = {shape.body: shape for shape in scene_of(robot_of(xml)).with_role("collision")}
    assert len(geometry.geometryObjects) == len(shapes) > 1
    for theirs in geometry.geometryObjects:
        frame = model.frames[theirs.parentFrame]
        ours = shapes[frame.name]
        assert (ours.geometry.radius, ours.geometry.length / 2) == (theirs.geometry.radius, theirs.geometry.halfLength)
        placed = frame.placement * pin.SE3(np.asarray(ours.placement))
        np.testing.assert_allclose(placed.homogeneous, theirs.placement.homogeneous, rtol=0, atol=TOLERANCE)


ROBOT = (
    '<robot name="r"{version}><link name="a"/><link name="b"/><joint name="j" type="{type}"><parent link="a"/>'
    '<child link="b"/><origin xyz="1 2 3" {turn}/><axis xyz="0 0 1"/><limit {limit}/></joint></robot>'
)
LIMIT = 'lower="-1" upper="1" effort="1" velocity="1"'
VERSIONS = ("", ' version="1.0"', ' version="1.1"', ' version="1.2"')


def _xml(version: str, turn: str = "", limit: str = LIMIT, type: str = "revolute") -> str:
    return ROBOT.format(version=version, turn=turn, limit=limit, type=type)


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize(
    "turn",
    [
        'quat_xyzw="0 0 0.6 0.8"',
        'quat_xyzw="1 2 -3 4"',
        'quat_xyzw="0 0 0 0"',
        'quat_xyzw="0 0 1e-9 1e-9"',
        'quat_xyzw="0 0 1"',
        'rpy="0 0 1" quat_xyzw="0.6 0 0 0.8"',
        'rpy="1 2 3"',
    ],
)
@pytest.mark.parametrize("limit", [LIMIT, 'lower="-1" upper="1"', 'upper="1" effort="1" velocity="1"'])
def test_each_version_is_read_or_refused_as_by_pinocchio(
    robot_of: Callable[[str], Robot], version: str, turn: str, limit: str
) -> None:
    xml = _xml(version, turn, limit)
    try:
        theirs = pin.buildModelFromXML(xml)
    except ValueError:
        with pytest.raises(ModelError):
            robot_of(xml)
        return
    ours = Kinematics(robot_of(xml)).model
    np.testing.assert_allclose(ours.jointPlacements[1].homogeneous, theirs.jointPlacements[1].homogeneous, atol=1e-15)
    for name in ("lowerPositionLimit", "upperPositionLimit", "upperEffortLimit", "upperVelocityLimit"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name), err_msg=name)


def test_limits_of_acceleration_and_jerk_are_read_in_version_1_2_only(robot_of: Callable[[str], Robot]) -> None:
    limit = f'{LIMIT} acceleration="2" deceleration="3" jerk="4"'
    found = [robot_of(_xml(version, limit=limit)).joints[0].limit for version in VERSIONS]
    assert [(one.acceleration, one.deceleration, one.jerk) for one in found] == [(None,) * 3] * 3 + [(2.0, 3.0, 4.0)]


def test_the_same_rotation_in_both_forms_is_read(robot_of: Callable[[str], Robot]) -> None:
    joint = robot_of(_xml(VERSIONS[2], 'rpy="0 0 1.5708" quat_xyzw="0 0 1 1"')).joints[0]
    assert joint.origin.rpy == (0.0, 0.0, np.pi / 2)


@pytest.mark.parametrize(
    ("version", "rpy"),
    [("2.0", 1.0), ("1.3", 1.0), ("1.2.1", 1.0), ("1", 0.0), ("0.9", 0.0), ("x", 0.0), ("9" * 5000 + ".1", 1.0)],
)
def test_an_unknown_version_is_read_as_the_nearest_one(
    robot_of: Callable[[str], Robot], version: str, rpy: float
) -> None:
    turn = f'quat_xyzw="0 0 {np.sin(0.5)} {np.cos(0.5)}"'
    joint = robot_of(_xml(f' version="{version}"', turn)).joints[0]
    assert joint.origin.rpy == pytest.approx((0.0, 0.0, rpy), abs=1e-15)
