"""Chain: poses and Jacobians against Pinocchio, for every kind of joint and for bases above and below the tip."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from tests.kinematics.arms import Reference, random_configurations
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Chain

MOBILE = """<robot name="mobile"><link name="floor"/><link name="base"/><link name="lift"/><link name="hand"/>
<joint name="drive" type="planar"><parent link="floor"/><child link="base"/>
  <origin xyz="0.1 0.2 0.3" rpy="0.1 0.2 0.3"/><axis xyz="{axis}"/></joint>
<joint name="torso" type="prismatic"><parent link="base"/><child link="lift"/><axis xyz="0 0 1"/>
  <limit lower="0" upper="0.5" effort="1" velocity="1"/></joint>
<joint name="bend" type="revolute"><parent link="lift"/><child link="hand"/><origin xyz="0.4 0 0"/><axis xyz="0 1 0"/>
  <limit lower="-2" upper="2" effort="1" velocity="1"/></joint></robot>"""


@pytest.mark.parametrize(
    ("base", "tip"),
    [
        ("world", "camera"),
        ("world", "finger_b"),
        ("camera", "world"),
        ("finger_a", "camera_optical"),
        ("lift", "elbow"),
    ],
)
def test_poses_are_those_of_pinocchio(arm: Robot, base: str, tip: str) -> None:
    chain = Chain(arm, base, tip)
    q = random_configurations(chain, 20)
    np.testing.assert_allclose(chain.forward(q), Reference(chain).poses(q), rtol=0, atol=1e-12)
    np.testing.assert_array_equal(chain.forward(q[3]), chain.forward(q)[3])


@pytest.mark.parametrize(
    ("base", "tip"), [("world", "finger_b"), ("camera", "world"), ("finger_a", "camera_optical"), (None, "plate")]
)
def test_jacobians_are_the_derivatives_of_pinocchios_poses(arm: Robot, base: str | None, tip: str) -> None:
    chain = Chain(arm, base, tip)
    reference = Reference(chain)
    for q in random_configurations(chain, 5, 1):
        jacobian = chain.jacobian(q)
        assert jacobian.shape == (6, len(chain.joint_names))
        pose = reference.pose(q)
        for j in range(len(q)):
            ahead, behind = q.copy(), q.copy()
            ahead[j], behind[j] = q[j] + 1e-6, q[j] - 1e-6
            rate = (reference.pose(ahead) - reference.pose(behind)) / 2e-6
            turn = rate[:3, :3] @ pose[:3, :3].T
            expected = [*rate[:3, 3], turn[2, 1], turn[0, 2], turn[1, 0]]
            np.testing.assert_allclose(jacobian[:, j], expected, rtol=0, atol=1e-8)


def test_only_leaders_of_mimic_joints_are_variables(arm: Robot) -> None:
    chain = Chain(arm, "world", "camera")
    assert chain.joint_names == ("turn", "slide", "bend")
    # dial = 1.5 · bend - 0.2 has the limits -3 and 3, those of bend are -1.5 and 2.
    np.testing.assert_allclose(chain.lower, [-np.inf, -0.1, -1.5], atol=1e-15)
    np.testing.assert_allclose(chain.upper, [np.inf, 0.4, 2.0], atol=1e-15)


@pytest.mark.parametrize("axis", ["0 0 1", "0 0 -1", "1 2 -1", "0 -1 0"])
@pytest.mark.parametrize(("base", "tip"), [("floor", "hand"), ("hand", "floor")])
def test_planar_joints_have_three_variables(robot_of: Callable[[str], Robot], axis: str, base: str, tip: str) -> None:
    chain = Chain(robot_of(MOBILE.format(axis=axis)), base, tip)
    expected = ["drive/x", "drive/y", "drive/theta", "torso", "bend"]
    assert list(chain.joint_names) == (expected if base == "floor" else ["bend", "torso", *expected[2::-1]])
    q = random_configurations(chain, 10)
    np.testing.assert_allclose(chain.forward(q), Reference(chain).poses(q), rtol=0, atol=1e-12)


@pytest.mark.parametrize(("base", "tip"), [("world", "camera"), ("finger_b", "world")])
def test_joints_are_held(arm: Robot, base: str, tip: str) -> None:
    hold = {"slide": 0.13, "turn": 0.7, "grip": 0.01}
    chain = Chain(arm, base, tip, hold=hold)
    assert chain.joint_names == ("bend",)
    q = random_configurations(chain, 5)
    np.testing.assert_allclose(chain.forward(q), Reference(chain).poses(q, hold), rtol=0, atol=1e-12)


def test_floating_joints_are_held(robot_of: Callable[[str], Robot]) -> None:
    floating = MOBILE.format(axis="0 0 1").replace('type="planar"', 'type="floating"')
    hold = {"drive/trans_y": 0.4, "drive/rot_x": 0.6, "drive/rot_w": 0.8}
    for base, tip in (("floor", "hand"), ("hand", "floor")):
        chain = Chain(robot_of(floating), base, tip, hold=hold)
        assert set(chain.joint_names) == {"torso", "bend"}
        q = random_configurations(chain, 5)
        np.testing.assert_allclose(chain.forward(q), Reference(chain).poses(q, hold), rtol=0, atol=1e-12)


def test_large_angles_keep_their_precision(pair: Callable[..., Robot]) -> None:
    chain = Chain(pair("continuous", '<axis xyz="0 0 1"/>'), "a", "b")
    q = np.array([[1e4], [-123456.7], [1e9]])
    np.testing.assert_allclose(chain.forward(q), Reference(chain).poses(q), rtol=0, atol=2e-7)
    np.testing.assert_allclose(chain.forward(q[:2]), Reference(chain).poses(q[:2]), rtol=0, atol=1e-10)


def test_more_joints_than_one_block_of_the_kernel(robot_of: Callable[[str], Robot]) -> None:
    links = "".join(f'<link name="l{k}"/>' for k in range(31))
    joints = "".join(
        f'<joint name="j{k}" type="continuous"><parent link="l{k}"/><child link="l{k + 1}"/>'
        f'<origin xyz="0.1 0 0"/><axis xyz="{"0 1 0" if k % 2 else "0 0 1"}"/></joint>'
        for k in range(30)
    )
    chain = Chain(robot_of(f'<robot name="snake">{links}{joints}</robot>'), "l0", "l30")
    q = random_configurations(chain, 5)
    np.testing.assert_allclose(chain.forward(q), Reference(chain).poses(q), rtol=0, atol=1e-12)
    found = chain.solve(chain.forward(q))
    assert found.reached.all()


def test_a_link_and_a_joint_of_one_name(robot_of: Callable[[str], Robot]) -> None:
    xml = MOBILE.format(axis="0 0 1").replace('joint name="bend"', 'joint name="hand"')
    chain = Chain(robot_of(xml), "lift", "hand")
    assert chain.joint_names == ("hand",)


@pytest.mark.parametrize(
    ("base", "tip", "hold", "message"),
    [
        ("worl", "camera", {}, "no frame `worl` in robot `arm`; did you mean `world`?"),
        (
            "world",
            "bend",
            {},
            "no frame `bend` in robot `arm`; `bend` is a joint, its frame is that of its child link `elbow`",
        ),
        ("world", "world", {}, "no joint moves `world` relative to `world` in robot `arm`"),
        ("lift", "plate", {}, "no joint moves `plate` relative to `lift` in robot `arm`"),
        ("world", "camera", {"bent": 1.0}, "no movable joint `bent` in robot `arm`; did you mean `bend`?"),
        (
            "world",
            "camera",
            {"dial_joint": 1.0},
            "joint `dial_joint` mimics another joint (1.5 · bend + -0.2); set `bend` instead",
        ),
        ("world", "camera", {"bend": float("nan")}, "position of joint `bend` is nan; it must be a finite number"),
    ],
)
def test_wrong_names_are_refused(arm: Robot, base: str, tip: str, hold: dict[str, float], message: str) -> None:
    with pytest.raises(KinematicsError) as caught:
        Chain(arm, base, tip, hold=hold)
    assert str(caught.value) == message


def test_wrong_shapes_are_refused(arm: Robot) -> None:
    chain = Chain(arm, "world", "camera")
    for q in (0.0, [1.0, 2.0], np.zeros((2, 4))):
        with pytest.raises(KinematicsError, match="have 3 numbers; got shape"):
            chain.forward(q)
    with pytest.raises(KinematicsError, match=r"targets have the shape \(N, 7\) or \(N, 4, 4\); got \(6,\)"):
        chain.solve(np.zeros(6))
    with pytest.raises(KinematicsError, match="seeds have the shape"):
        chain.solve(chain.forward(np.zeros((3, 3))), np.zeros((2, 3)))


def test_no_configurations_have_no_poses(arm: Robot) -> None:
    chain = Chain(arm, "world", "camera")
    assert chain.forward(np.empty((0, 3))).shape == (0, 4, 4)
    assert chain.solve(np.empty((0, 7))).q.shape == (0, 3)
