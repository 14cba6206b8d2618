"""The model against Pinocchio's own reading of the same URDF, joint by joint and as a whole."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError, UrdfkitError
from urdfkit.kinematics import Kinematics

CORPUS = Path(__file__).parents[2].parent / "shared" / "corpus"


def random_configuration(model: Any, rng: np.random.Generator) -> Any:
    """Return a configuration; angles within ±π, lengths within ±1 m."""
    q = pin.integrate(model, pin.neutral(model), rng.uniform(-np.pi, np.pi, model.nv))
    assert q.shape == (model.nq,)
    return q


def assert_same_model(model: Any, reference: Any, rng: np.random.Generator) -> None:
    """Compare names, order, limits, frames, and the mass matrix and placements at random configurations."""
    assert list(model.names) == list(reference.names)
    assert [(j.nq, j.nv, j.idx_q) for j in model.joints] == [(j.nq, j.nv, j.idx_q) for j in reference.joints]
    assert [(f.name, f.type, f.parentJoint, f.parentFrame) for f in model.frames] == [
        (f.name, f.type, f.parentJoint, f.parentFrame) for f in reference.frames
    ]
    for name in ("lowerPositionLimit", "upperPositionLimit", "upperEffortLimit", "lowerEffortLimit"):
        np.testing.assert_array_equal(getattr(model, name), getattr(reference, name), err_msg=name)
    for name in ("upperVelocityLimit", "lowerVelocityLimit", "damping", "upperDryFrictionLimit"):
        np.testing.assert_array_equal(getattr(model, name), getattr(reference, name), err_msg=name)
    data, reference_data = model.createData(), reference.createData()
    for _ in range(3):
        q = random_configuration(reference, rng)
        v, a = rng.normal(size=(2, reference.nv))
        pin.framesForwardKinematics(model, data, q)
        pin.framesForwardKinematics(reference, reference_data, q)
        for ours, theirs in zip(data.oMf, reference_data.oMf, strict=True):
            np.testing.assert_allclose(ours.homogeneous, theirs.homogeneous, rtol=0, atol=1e-12)
        if reference.nv:
            M = pin.crba(reference, reference_data, q)
            np.testing.assert_allclose(pin.crba(model, data, q), M, rtol=1e-12, atol=1e-12 * abs(M).max(initial=1))
            tau = pin.rnea(reference, reference_data, q, v, a)
            np.testing.assert_allclose(
                pin.rnea(model, data, q, v, a), tau, rtol=0, atol=1e-11 * abs(tau).max(initial=1)
            )


@pytest.mark.parametrize("floating_base", [False, True])
def test_an_arm_of_all_kinds_is_what_pinocchio_reads(arm: Robot, arm_xml: str, floating_base: bool) -> None:
    root = [pin.JointModelFreeFlyer()] if floating_base else []
    reference = pin.buildModelFromXML(arm_xml, *root)
    model = Kinematics(arm, floating_base=floating_base).model
    assert_same_model(model, reference, np.random.default_rng(1))
    for ours, theirs in zip(model.inertias, reference.inertias, strict=True):
        np.testing.assert_allclose(ours.matrix(), theirs.matrix(), rtol=0, atol=1e-14)


@pytest.mark.parametrize(
    "axis", ["1 0 0", "0 1 0", "0 0 1", "0 0 -1", "0 -5 0", "1 1 0", "0.3 -0.2 0.9", "1e-9 0 2e-9"]
)
@pytest.mark.parametrize("type", ["revolute", "continuous", "prismatic"])
def test_axes_are_normalised(pair: Callable[..., Robot], type: str, axis: str) -> None:
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    robot = pair(type, f'<axis xyz="{axis}"/>{limit}')
    kinematics = Kinematics(robot)
    J = pin.computeFrameJacobian(
        kinematics.model, kinematics.data, kinematics.neutral(), kinematics.frame("b"), pin.LOCAL
    ).reshape(6)
    expected = np.array([float(word) for word in axis.split()])
    expected /= np.linalg.norm(expected)
    moving = J[:3] if type == "prismatic" else J[3:]
    np.testing.assert_allclose(moving, expected, rtol=0, atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(J), 1.0, rtol=0, atol=1e-12)


def test_a_floating_joint_is_what_pinocchio_reads(robot_of: Callable[[str], Robot]) -> None:
    xml = (
        '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="2"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
        '<joint name="j" type="floating"><parent link="a"/><child link="b"/><origin xyz="1 2 3" rpy="1 0 0"/></joint>'
        "</robot>"
    )
    assert_same_model(Kinematics(robot_of(xml)).model, pin.buildModelFromXML(xml), np.random.default_rng(2))


def test_a_planar_joint_about_z_is_what_pinocchio_reads(robot_of: Callable[[str], Robot]) -> None:
    xml = (
        '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="2"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
        '<joint name="j" type="planar"><parent link="a"/><child link="b"/><origin xyz="1 2 3" rpy="1 0 0"/>'
        '<axis xyz="0 0 1"/></joint></robot>'
    )
    assert_same_model(Kinematics(robot_of(xml)).model, pin.buildModelFromXML(xml), np.random.default_rng(3))


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, 2.0, 0.0), (0.0, 0.0, -1.0), (1.0, -1.0, 3.0)])
def test_a_planar_joint_moves_perpendicular_to_its_axis(
    pair: Callable[..., Robot], axis: tuple[float, float, float]
) -> None:
    kinematics = Kinematics(pair("planar", f'<axis xyz="{axis[0]} {axis[1]} {axis[2]}"/>'))
    normal = np.array(axis) / np.linalg.norm(axis)
    start = _in_parent(kinematics, {})
    np.testing.assert_allclose(start.translation, [0.1, 0.0, 0.2], rtol=0, atol=1e-15)
    moved = _in_parent(kinematics, {"j/x": 0.3, "j/y": -0.7, "j/theta": 0.9})
    shift = start.actInv(moved)
    assert abs(shift.translation @ normal) < 1e-14
    assert np.linalg.norm(shift.translation) == pytest.approx(np.hypot(0.3, 0.7), abs=1e-14)
    np.testing.assert_allclose(pin.log3(shift.rotation), 0.9 * normal, rtol=0, atol=1e-14)


def _in_parent(kinematics: Kinematics, positions: dict[str, float]) -> Any:
    pin.framesForwardKinematics(kinematics.model, kinematics.data, kinematics.configuration(positions))
    return kinematics.data.oMf[kinematics.frame("b")].copy()


def test_a_massless_root_and_links_without_inertial_are_fine(robot_of: Callable[[str], Robot]) -> None:
    robot = robot_of(
        '<robot name="r"><link name="base_footprint"/><link name="base_link"><inertial><mass value="2"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
        '<joint name="j" type="fixed"><parent link="base_footprint"/><child link="base_link"/>'
        '<origin xyz="0 0 0.3"/></joint></robot>'
    )
    kinematics = Kinematics(robot, floating_base=True)
    assert kinematics.root == "base_footprint"
    inertia = kinematics.model.inertias[1]
    assert inertia.mass == 2.0
    np.testing.assert_allclose(inertia.lever, [0, 0, 0.3], rtol=0, atol=1e-15)


def test_a_joint_may_have_the_name_of_the_free_flyer(robot_of: Callable[[str], Robot]) -> None:
    robot = robot_of(
        '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
        '<joint name="root_joint" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>'
        "</robot>"
    )
    kinematics = Kinematics(robot, floating_base=True)
    assert kinematics.joint_names == ("root_joint",)
    assert kinematics.velocity_index("root_joint") == 6


def test_a_link_may_have_the_name_of_a_joint(robot_of: Callable[[str], Robot]) -> None:
    robot = robot_of(
        '<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/>'
        '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
        '<link name="universe"/><joint name="b" type="continuous"><parent link="a"/><child link="b"/>'
        '<origin xyz="1 0 0"/><axis xyz="0 0 1"/></joint>'
        '<joint name="a" type="fixed"><parent link="b"/><child link="universe"/><origin xyz="0 2 0"/></joint></robot>'
    )
    kinematics = Kinematics(robot)
    poses = kinematics.link_poses(kinematics.configuration({"b": np.pi / 2}))
    np.testing.assert_allclose(poses[:, :3], [[0, 0, 0], [1, 0, 0], [-1, 0, 0]], rtol=0, atol=1e-15)


def test_a_chain_longer_than_the_recursion_limit(robot_of: Callable[[str], Robot]) -> None:
    count = 1500
    links = "".join(f'<link name="l{i}"/>' for i in range(count + 1))
    joints = "".join(
        f'<joint name="j{i}" type="fixed"><parent link="l{i}"/><child link="l{i + 1}"/>'
        '<origin xyz="0.001 0 0"/></joint>'
        for i in range(count)
    )
    kinematics = Kinematics(robot_of(f'<robot name="chain">{links}{joints}</robot>'))
    poses = kinematics.link_poses(kinematics.neutral())
    assert poses[-1, 0] == pytest.approx(1.5, abs=1e-12)


def test_two_roots_are_named(arm: Robot) -> None:
    broken = replace(arm, joints=arm.joints[:-1])  # type: ignore[type-var]
    with pytest.raises(
        KinematicsError, match=r"`arm` does not form a single tree of links; its roots: `world`, `camera_optical`"
    ):
        Kinematics(broken)


def test_a_zero_axis_is_refused_at_its_place(pair: Callable[..., Robot]) -> None:
    with pytest.raises(UrdfkitError, match=r"robot\.urdf:1:\d+: .*axis"):
        Kinematics(pair("continuous", '<axis xyz="0 0 0"/>'))


@pytest.mark.parametrize("axis", [(0.0, 0.0, 0.0), (1e200, 0.0, 0.0)])
def test_axes_that_a_program_sets_are_checked_too(pair: Callable[..., Robot], axis: tuple[float, float, float]) -> None:
    written = pair("continuous")
    broken = replace(written, joints=(replace(written.joints[0], axis=axis),))  # type: ignore[type-var]
    with pytest.raises(KinematicsError, match=r"robot\.urdf:1:\d+: joint `j` has the axis .*; it must not be zero"):
        Kinematics(broken)


@pytest.mark.slow
@pytest.mark.skipif(not CORPUS.is_dir(), reason="the corpus is not next to the checkout")
def test_the_corpus_is_what_pinocchio_reads(capfd: pytest.CaptureFixture[str]) -> None:
    rng = np.random.default_rng(4)
    compared = 0
    for path in sorted(CORPUS.rglob("*.urdf")):
        try:
            robot = load(path)
            kinematics = Kinematics(robot)
        except UrdfkitError:
            continue
        xml = path.read_text(encoding="utf-8", errors="replace")
        reference = pin.buildModelFromXML(xml)
        if "Error" in capfd.readouterr().err:
            continue  # urdfdom could not read all of it
        assert_same_model(kinematics.model, reference, rng)
        compared += 1
    assert compared > 60
