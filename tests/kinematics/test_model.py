from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from hypothesis import strategies as st

from urdfkit.description import load
from urdfkit.description.urdf.queries import tree_order
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError, UrdfkitError
from urdfkit.kinematics import JointLimitError, Kinematics

angles = st.floats(-3.0, 3.0)


@pytest.fixture
def kinematics(arm: Robot) -> Kinematics:
    return Kinematics(arm)


def test_names(kinematics: Kinematics, arm: Robot) -> None:
    assert kinematics.joint_names == ("turn", "slide", "bend", "grip")
    assert kinematics.mimic_names == ("grip_mirror", "dial_joint")
    assert kinematics.variable_names == kinematics.joint_names
    assert kinematics.link_names == tuple(link.name for link in arm.links)
    assert kinematics.root == "world"
    assert kinematics.model.nq == 7
    assert kinematics.model.nv == 6


def test_positions_come_out_as_they_went_in(kinematics: Kinematics) -> None:
    q = kinematics.configuration({"turn": 2.5, "slide": 0.2, "bend": -1.0, "grip": 0.03})
    assert kinematics.positions(q) == pytest.approx(
        {"turn": 2.5, "slide": 0.2, "bend": -1.0, "grip": 0.03, "grip_mirror": -0.029, "dial_joint": -1.7}, abs=1e-15
    )
    # A continuous joint is one angle by name, cosine and sine in q.
    at = kinematics.configuration_index("turn")
    assert q[at : at + 2] == pytest.approx([np.cos(2.5), np.sin(2.5)])


@given(turns=st.floats(-1e3, 1e3))
def test_a_continuous_joint_wraps(turns: float) -> None:
    kinematics = Kinematics(_wheel())
    found = kinematics.positions(kinematics.configuration({"j": turns}))["j"]
    assert -np.pi <= found <= np.pi
    assert np.cos(found - turns) == pytest.approx(1.0, abs=1e-9)


def _wheel() -> Robot:
    from urdfkit.description.urdf.robot import Joint, Link, Pose
    from urdfkit.description.xml.element import Element
    from urdfkit.description.xml.source import Origin, Position

    element = Element("x", {}, [], "", Origin(Position("wheel.urdf", 1, 1)))
    links = tuple(Link(name, None, (), (), element) for name in ("a", "b"))
    joint = Joint("j", "continuous", "a", "b", Pose(), (0.0, 1.0, 0.0), None, None, None, None, None, element)
    return Robot("wheel", links, (joint,), (), (), (), (), (), element)


def test_neutral_leaves_mimic_joints_at_their_offset(kinematics: Kinematics) -> None:
    positions = kinematics.positions(kinematics.neutral())
    assert positions["dial_joint"] == pytest.approx(-0.2)
    assert positions["grip_mirror"] == pytest.approx(0.001)


def test_velocities_follow(kinematics: Kinematics) -> None:
    v = kinematics.velocity({"bend": 2.0, "turn": -1.0})
    assert v.shape == (6,)
    assert kinematics.velocities(v) == pytest.approx(
        {"turn": -1.0, "slide": 0.0, "bend": 2.0, "dial_joint": 3.0, "grip": 0.0, "grip_mirror": 0.0}
    )
    assert v[kinematics.velocity_index("bend")] == 2.0


def test_a_mimicking_robot_integrates_along_its_couplings(kinematics: Kinematics) -> None:
    q = kinematics.configuration({"turn": 0.3, "bend": 0.1})
    v = kinematics.velocity({"turn": 1.0, "bend": 0.5, "grip": 0.02})
    later = pin.integrate(kinematics.model, q, v * 0.7)
    expected = kinematics.configuration({"turn": 1.0, "bend": 0.45, "grip": 0.014})
    np.testing.assert_allclose(later, expected, rtol=0, atol=1e-14)


def test_reduced_dynamics_are_those_of_pinocchios_mimic_model(kinematics: Kinematics, arm_xml: str) -> None:
    reference = pin.buildModelFromXML(arm_xml, mimic=True)
    data = reference.createData()
    rng = np.random.default_rng(5)
    own = {name: i for i, name in enumerate(reference.names) if name in kinematics.joint_names}
    # Where the reference's joints are among our independent ones.
    order = [
        list(kinematics.independent).index(kinematics.velocity_index(name))
        for name in sorted(own, key=lambda name: reference.joints[own[name]].idx_v)
    ]
    G = kinematics.mimic_matrix[:, order]
    for _ in range(5):
        positions = {name: float(rng.uniform(-1, 1)) for name in kinematics.joint_names}
        q = kinematics.configuration(positions)
        reduced = np.concatenate(
            [
                [np.cos(positions[name]), np.sin(positions[name])] if name == "turn" else [positions[name]]
                for name in sorted(own, key=lambda name: reference.joints[own[name]].idx_q)
            ]
        )
        M = pin.crba(kinematics.model, kinematics.data, q)
        np.testing.assert_allclose(G.T @ M @ G, pin.crba(reference, data, reduced), rtol=0, atol=1e-12)
        weights = pin.computeGeneralizedGravity(reference, data, reduced)
        np.testing.assert_allclose(G.T @ kinematics.gravity(q), weights, rtol=0, atol=1e-12 * abs(weights).max())
        pin.framesForwardKinematics(reference, data, reduced)
        pin.framesForwardKinematics(kinematics.model, kinematics.data, q)
        for frame in kinematics.link_names:
            np.testing.assert_allclose(
                kinematics.data.oMf[kinematics.frame(frame)].homogeneous,
                data.oMf[reference.getFrameId(frame, pin.BODY)].homogeneous,
                rtol=0,
                atol=1e-12,
            )


def test_mimics_of_mimics_and_of_other_kinds_are_followed(robot_of: Callable[[str], Robot]) -> None:
    robot = robot_of(_chain(c='<mimic joint="b" multiplier="2" offset="0.1"/>', b='<mimic joint="a" multiplier="-3"/>'))
    kinematics = Kinematics(robot)
    assert kinematics.joint_names == ("a",)
    positions = kinematics.positions(kinematics.configuration({"a": 0.1}))
    assert positions == pytest.approx({"a": 0.1, "b": -0.3, "c": -0.5})
    np.testing.assert_allclose(kinematics.mimic_matrix[:, 0], [1.0, -3.0, -6.0])


def test_a_mimic_of_a_fixed_joint_stays_at_its_offset(robot_of: Callable[[str], Robot]) -> None:
    kinematics = Kinematics(robot_of(_chain(b='<mimic joint="weld" offset="0.2"/>')))
    assert kinematics.positions(kinematics.configuration({"a": 0.1}))["b"] == 0.2
    assert kinematics.velocities(kinematics.velocity({"a": 1.0}))["b"] == 0.0
    with pytest.raises(KinematicsError, match=r"`b` mimics a fixed joint: it stays at 0\.2"):
        kinematics.configuration({"b": 0.0})


@pytest.mark.parametrize(
    ("mimics", "message"),
    [
        ({"b": '<mimic joint="arm"/>'}, r"`b` mimics the unknown joint `arm`"),
        ({"b": '<mimic joint="c"/>', "c": '<mimic joint="b"/>'}, r"cycle: `b` → `c` → `b`"),
        ({"b": '<mimic joint="b"/>'}, r"cycle: `b` → `b`"),
    ],
)
def test_mimics_that_make_no_sense_are_refused_at_their_place(
    robot_of: Callable[[str], Robot], mimics: dict[str, str], message: str
) -> None:
    with pytest.raises(UrdfkitError, match=message) as caught:
        Kinematics(robot_of(_chain(**mimics)))
    assert caught.value.position is not None


def _chain(a: str = "", b: str = "", c: str = "") -> str:
    """Return a robot of a revolute, a prismatic and another revolute joint, with these children, and a fixed one."""
    limit = '<limit lower="-1" upper="1" effort="1" velocity="1"/>'
    inertial = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    links = "".join(f'<link name="l{i}">{inertial if i else ""}</link>' for i in range(5))
    kinds = (("a", "revolute", a), ("b", "prismatic", b), ("c", "revolute", c))
    joints = "".join(
        f'<joint name="{name}" type="{kind}"><parent link="l{i}"/><child link="l{i + 1}"/><axis xyz="0 0 1"/>'
        f"{limit}{body}</joint>"
        for i, (name, kind, body) in enumerate(kinds)
    )
    weld = '<joint name="weld" type="fixed"><parent link="l3"/><child link="l4"/></joint>'
    return f'<robot name="chain">{links}{joints}{weld}</robot>'


@pytest.mark.parametrize(
    ("positions", "message"),
    [
        ({"tun": 1.0}, r"no movable joint `tun` in robot `arm`; did you mean `turn`\?"),
        ({"post": 1.0}, r"joint `post` is fixed: it does not move"),
        ({"dial_joint": 1.0}, r"joint `dial_joint` mimics another joint \(1\.5 · bend \+ -0\.2\); set `bend` instead"),
        ({"turn": float("nan")}, r"position of joint `turn` is nan; it must be a finite number"),
        ({"slide": float("inf")}, r"position of joint `slide` is inf"),
    ],
)
def test_what_cannot_be_set_is_refused(kinematics: Kinematics, positions: dict[str, float], message: str) -> None:
    with pytest.raises(KinematicsError, match=message):
        kinematics.configuration(positions)


def test_limits_are_checked_when_asked(kinematics: Kinematics) -> None:
    kinematics.configuration({"slide": 0.5})
    kinematics.configuration({"slide": 0.4, "bend": 1.2}, check_limits=True)
    with pytest.raises(
        JointLimitError, match=r"joint `slide` at 0\.5 m is outside its limits \[-0\.1, 0\.4\] m"
    ) as caught:
        kinematics.configuration({"slide": 0.5}, check_limits=True)
    assert (caught.value.joint, caught.value.value, caught.value.lower, caught.value.upper) == ("slide", 0.5, -0.1, 0.4)
    # The follower leaves its limits before its leader does.
    with pytest.raises(JointLimitError, match=r"`dial_joint` at -3\.05 rad is outside its limits \[-3, 3\] rad"):
        Kinematics(_wider(kinematics.robot)).configuration({"bend": -1.9}, check_limits=True)
    assert kinematics.limits("turn") == (-np.inf, np.inf)


def _wider(robot: Robot) -> Robot:
    from dataclasses import replace

    from urdfkit.description.urdf.robot import Limit

    def widen(joint: Any) -> Any:
        if joint.name != "bend":
            return joint
        return replace(joint, limit=Limit(-9.0, 9.0, 1.0, 1.0, joint.limit.element))

    return replace(robot, joints=tuple(widen(joint) for joint in robot.joints))  # type: ignore[type-var]


def test_a_planar_joint_has_three_names(pair: Callable[..., Robot]) -> None:
    kinematics = Kinematics(pair("planar", '<axis xyz="0 0 1"/>'))
    assert kinematics.joint_names == ()
    assert kinematics.variable_names == ("j/x", "j/y", "j/theta")
    positions = {"j/x": 0.1, "j/y": -0.2, "j/theta": 0.3}
    assert kinematics.positions(kinematics.configuration(positions)) == pytest.approx(positions)
    with pytest.raises(KinematicsError, match=r"`j` is planar and has more than one position: `j/x`, `j/y`, `j/theta`"):
        kinematics.configuration({"j": 0.1})
    assert kinematics.velocities(np.zeros(3)) == {}


def test_a_floating_joint_has_seven_names_and_a_unit_quaternion(pair: Callable[..., Robot]) -> None:
    kinematics = Kinematics(pair("floating"))
    assert kinematics.positions(kinematics.neutral())["j/rot_w"] == 1.0
    q = kinematics.configuration({"j/trans_y": 2.0, "j/rot_x": 3.0, "j/rot_w": 4.0})
    np.testing.assert_allclose(q, [0, 2, 0, 0.6, 0, 0, 0.8])
    with pytest.raises(KinematicsError, match="quaternion"):
        kinematics.configuration({"j/rot_w": 0.0})


def test_a_floating_base_is_the_pose_of_the_root_link(arm: Robot) -> None:
    kinematics = Kinematics(arm, floating_base=True)
    base = np.array([1.0, 2.0, 3.0, 0.0, 0.0, 2.0, 0.0])
    q = kinematics.configuration({"turn": 0.4}, base=base)
    np.testing.assert_allclose(kinematics.link_poses(q)[0], [1, 2, 3, 0, 0, 1, 0], rtol=0, atol=1e-15)
    v = kinematics.velocity({"turn": 1.0}, base=np.arange(6.0))
    np.testing.assert_allclose(v[:6], np.arange(6.0))
    assert kinematics.velocity_index("turn") == 6
    assert kinematics.configuration_index("turn") == 7
    assert len(kinematics.independent) == 6 + 4


def test_a_fixed_base_has_no_pose(kinematics: Kinematics) -> None:
    with pytest.raises(KinematicsError, match=r"root link `world` of robot `arm` has no floating base"):
        kinematics.configuration(base=np.array([0.0, 0, 0, 0, 0, 0, 1]))
    with pytest.raises(KinematicsError, match="has no floating base"):
        kinematics.velocity(base=np.zeros(6))


def test_link_poses_are_the_chained_origins(kinematics: Kinematics) -> None:
    """Chain the URDF's origins by hand, without Pinocchio."""
    positions = kinematics.followed({"turn": 0.7, "slide": 0.1, "bend": 0.5, "grip": 0.01})
    poses = dict(
        zip(
            kinematics.link_names,
            kinematics.link_poses(kinematics.configuration({"turn": 0.7, "slide": 0.1, "bend": 0.5, "grip": 0.01})),
            strict=True,
        )
    )
    placed = {"world": np.eye(4)}
    for joint in tree_order(kinematics.robot):
        placed[joint.child or ""] = placed[joint.parent or ""] @ _origin(joint) @ _motion(joint, positions)
    for name, matrix in placed.items():
        pose = poses[name]
        np.testing.assert_allclose(pose[:3], matrix[:3, 3], rtol=0, atol=1e-14)
        np.testing.assert_allclose(pin.Quaternion(pose[3:]).matrix(), matrix[:3, :3], rtol=0, atol=1e-14)


def _rotation(axis: Any, angle: float) -> Any:
    """Return Rodrigues' matrix."""
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    R = np.eye(4)
    R[:3, :3] = np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K
    return R


def _origin(joint: Any) -> Any:
    roll, pitch, yaw = joint.origin.rpy
    placement = _rotation((0, 0, 1), yaw) @ _rotation((0, 1, 0), pitch) @ _rotation((1, 0, 0), roll)
    placement[:3, 3] = joint.origin.xyz
    return placement


def _motion(joint: Any, positions: dict[str, float]) -> Any:
    if joint.type == "fixed":
        return np.eye(4)
    if joint.type == "prismatic":
        motion = np.eye(4)
        motion[:3, 3] = np.array(joint.axis) / np.linalg.norm(joint.axis) * positions[joint.name]
        return motion
    return _rotation(joint.axis, positions[joint.name])


@given(turn=angles, bend=angles, slide=st.floats(-1, 1))
def test_frame_jacobians_are_finite_differences(turn: float, bend: float, slide: float) -> None:
    kinematics = _ARM_KINEMATICS()
    model, data = kinematics.model, kinematics.data
    q = kinematics.configuration({"turn": turn, "bend": bend, "slide": slide})
    frame = kinematics.frame("camera_optical")
    J = pin.computeFrameJacobian(model, data, q, frame, pin.LOCAL).copy()
    pin.framesForwardKinematics(model, data, q)
    here = data.oMf[frame].copy()
    step = 1e-6
    for i in range(model.nv):
        v = np.zeros(model.nv)
        v[i] = step
        ends = []
        for sign in (1.0, -1.0):
            pin.framesForwardKinematics(model, data, pin.integrate(model, q, sign * v))
            ends.append(pin.log6(here.actInv(data.oMf[frame])).vector)
        np.testing.assert_allclose((ends[0] - ends[1]) / (2 * step), J[:, i], rtol=0, atol=1e-8)


class _Lazy:
    """The arm, built once for the property tests (hypothesis cannot take function fixtures)."""

    def __init__(self) -> None:
        self.found: Kinematics | None = None

    def __call__(self) -> Kinematics:
        if self.found is None:
            import tempfile
            from pathlib import Path

            from urdfkit.description import load

            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder) / "arm.urdf"
                path.write_text(_arm_xml(), encoding="utf-8")
                self.found = Kinematics(load(path))
        return self.found


_ARM_KINEMATICS = _Lazy()


def _arm_xml() -> str:
    import re
    from pathlib import Path

    source = (Path(__file__).parent / "conftest.py").read_text(encoding="utf-8")
    return re.findall(r'ARM = """(.*?)"""', source, re.DOTALL)[0]


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("camera_optica", r"no frame `camera_optica` in robot `arm`; did you mean `camera_optical`\?"),
        ("Lift", r"did you mean `lift`\?"),
        ("bend", r"`bend` is a joint, its frame is that of its child link `elbow`"),
    ],
)
def test_an_unknown_frame_names_the_nearest(kinematics: Kinematics, name: str, message: str) -> None:
    with pytest.raises(KinematicsError, match=message):
        kinematics.frame(name)


def test_indices_of_joints_that_do_not_move_are_refused(kinematics: Kinematics) -> None:
    with pytest.raises(KinematicsError, match="does not move"):
        kinematics.velocity_index("post")
    with pytest.raises(KinematicsError, match="no movable joint"):
        kinematics.configuration_index("nothing")


def test_a_chain_of_mimics_is_followed_once(tmp_path: Path) -> None:
    from types import SimpleNamespace

    from urdfkit.kinematics.mimic import couplings

    class Counted(dict[str, Any]):
        searches = 0

        def get(self, *words: Any) -> Any:
            self.searches += 1
            return super().get(*words)

    count = 300
    joints = [
        f'<link name="l{i}"/><joint name="j{i}" type="prismatic"><parent link="base"/><child link="l{i}"/>'
        f'<axis xyz="0 0 1"/><limit lower="0" upper="1" effort="1" velocity="1"/>{mimic}</joint>'
        for i, mimic in enumerate(
            [f'<mimic joint="j{i + 1}" multiplier="-1" offset="1"/>' for i in range(count - 1)] + [""]
        )
    ]
    (tmp_path / "r.urdf").write_text(f'<robot name="r"><link name="base"/>{"".join(joints)}</robot>')
    robot = load(tmp_path / "r.urdf")
    searched = Counted(robot.joint_by_name)
    found = couplings(SimpleNamespace(joints=robot.joints, joint_by_name=searched))  # type: ignore[arg-type]
    assert [(c.master, c.multiplier, c.offset) for c in found.values()] == [
        (f"j{count - 1}", (-1.0) ** (count - 1 - i), float((count - 1 - i) % 2)) for i in range(count - 1)
    ]
    assert searched.searches == count - 1


@pytest.mark.parametrize("q", [[0.0], "bend", [[0.0]], [0.0, [1.0]], None])
def test_a_configuration_of_another_robot_is_refused(kinematics: Kinematics, q: Any) -> None:
    with pytest.raises(KinematicsError, match=r"q is .*; robot `.*` needs \d+ numbers"):
        kinematics.link_poses(q)


def test_link_poses_take_a_list(kinematics: Kinematics) -> None:
    q = kinematics.neutral()
    assert np.array_equal(kinematics.link_poses(list(q)), kinematics.link_poses(q))
