from __future__ import annotations

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Kinematics, TransformTree
from urdfkit.resources import find_model


@pytest.fixture
def tree(arm: Robot) -> TransformTree:
    return TransformTree(arm)


def test_the_repr_names_the_robot_and_the_root(tree: TransformTree) -> None:
    assert repr(tree) == f"<TransformTree of {tree.kinematics.robot.name}: {len(tree.frames)} frames, root {tree.root}>"


def test_placements_are_those_of_pinocchio(tree: TransformTree, arm_xml: str) -> None:
    reference = pin.buildModelFromXML(arm_xml, mimic=True)
    data = reference.createData()
    rng = np.random.default_rng(7)
    for _ in range(10):
        positions = {name: float(rng.uniform(-3, 3)) for name in tree.kinematics.joint_names}
        q = pin.neutral(reference)
        for name, value in positions.items():
            joint = reference.joints[reference.getJointId(name)]
            q[joint.idx_q : joint.idx_q + joint.nq] = [np.cos(value), np.sin(value)] if joint.nq == 2 else [value]
        pin.framesForwardKinematics(reference, data, q)
        for parent, child in rng.choice(tree.frames, size=(8, 2)):
            expected = data.oMf[reference.getFrameId(parent, pin.BODY)].actInv(
                data.oMf[reference.getFrameId(child, pin.BODY)]
            )
            found = tree.placement(child, parent, positions)
            np.testing.assert_allclose(found.homogeneous, expected.homogeneous, rtol=0, atol=1e-12)


@pytest.mark.slow
@settings(max_examples=20)
@given(left=st.floats(-100, 100), right=st.floats(-100, 100))
def test_simpleton_is_what_pinocchio_says(left: float, right: float) -> None:
    from urdfkit.description.xacro.expand import expand

    path = find_model(["simpleton"]).path
    tree = TransformTree(load(path))
    reference = pin.buildModelFromXML(expand(path).xml)
    data = reference.createData()
    q = pin.neutral(reference)
    for name, value in (("left_wheel_joint", left), ("right_wheel_joint", right)):
        at = reference.joints[reference.getJointId(name)].idx_q
        q[at : at + 2] = np.cos(value), np.sin(value)
    pin.framesForwardKinematics(reference, data, q)
    positions = {"left_wheel_joint": left, "right_wheel_joint": right}
    for frame in tree.frames:
        expected = data.oMf[reference.getFrameId(frame, pin.BODY)].homogeneous
        found = tree.placement(frame, "base_footprint", positions).homogeneous
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


def test_a_placement_is_in_the_root_unless_told(tree: TransformTree) -> None:
    positions = {"turn": 0.3}
    assert tree.placement("plate", None, positions) == tree.placement("plate", "world", positions)
    assert tree.placement("plate", None) == tree.placement("plate", "world", tree.kinematics.neutral())


def test_placements_chain_and_invert(tree: TransformTree) -> None:
    q = tree.kinematics.configuration({"turn": 1.0, "bend": -0.4})
    whole = tree.placement("dial", "finger_a", q)
    chained = tree.placement("lift", "finger_a", q) * tree.placement("dial", "lift", q)
    np.testing.assert_allclose(whole.homogeneous, chained.homogeneous, rtol=0, atol=1e-14)
    back = tree.placement("finger_a", "dial", q).inverse()
    np.testing.assert_allclose(whole.homogeneous, back.homogeneous, rtol=0, atol=1e-14)


def test_a_placement_outlives_the_next_question(tree: TransformTree) -> None:
    first = tree.placement("plate", None, {"turn": 0.0})
    kept = first.homogeneous.copy()
    tree.placement("plate", None, {"turn": 2.0})
    np.testing.assert_array_equal(first.homogeneous, kept)


def test_a_floating_base_moves_the_world_not_the_tree(arm: Robot) -> None:
    floating = Kinematics(arm, floating_base=True)
    q = floating.configuration({"bend": 0.2}, base=np.array([1.0, 2, 3, 0, 0, 0, 1]))
    found = TransformTree(floating).placement("elbow", None, q)
    expected = TransformTree(arm).placement("elbow", None, {"bend": 0.2})
    np.testing.assert_allclose(found.homogeneous, expected.homogeneous, rtol=0, atol=1e-14)


def test_edges_and_parents(tree: TransformTree) -> None:
    assert tree.root == "world"
    assert tree.parents["world"] is None
    assert tree.parents["plate"] == "lift"
    assert set(tree.parents) == set(tree.frames)
    edges = {edge.joint: edge for edge in tree.edges}
    assert edges["post"].is_static
    assert not edges["turn"].is_static
    assert (edges["turn"].parent, edges["turn"].child, edges["turn"].type) == ("world", "turntable", "continuous")
    assert edges["dial_joint"].mimics == "bend"
    placed = {tree.root}
    for edge in tree.edges:  # parents before children
        assert edge.parent in placed
        placed.add(edge.child)


def test_a_transform_in_plain_numbers(tree: TransformTree) -> None:
    transform = tree.transform("camera", "camera_optical")
    assert (transform.parent, transform.child) == ("camera", "camera_optical")
    np.testing.assert_allclose(transform.quaternion, [-0.5, 0.5, -0.5, 0.5], rtol=0, atol=1e-15)
    np.testing.assert_allclose(transform.rpy, [-np.pi / 2, 0, -np.pi / 2], rtol=0, atol=1e-15)
    np.testing.assert_allclose(
        transform.matrix, [[0, 0, 1, 0], [-1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 0, 1]], rtol=0, atol=1e-15
    )
    assert "-0.0" not in f"{transform.translation} {transform.matrix}"


@pytest.mark.parametrize("turn", [-3.1, 3.1, 2 * np.pi - 0.1, 5.0])
def test_quaternions_have_no_negative_w(tree: TransformTree, turn: float) -> None:
    quaternion = tree.transform(None, "turntable", {"turn": turn}).quaternion
    assert quaternion[3] >= 0.0
    np.testing.assert_allclose(np.abs(quaternion), [0, 0, abs(np.sin(turn / 2)), abs(np.cos(turn / 2))], atol=1e-14)


def test_an_unknown_frame_is_refused(tree: TransformTree) -> None:
    with pytest.raises(KinematicsError, match=r"no frame `plat` in robot `arm`; did you mean `plate`\?"):
        tree.placement("plat")
    with pytest.raises(KinematicsError, match=r"no frame `worl`"):
        tree.placement("plate", "worl")
