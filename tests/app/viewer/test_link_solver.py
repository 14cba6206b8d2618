"""The solver of the page: poses, the choice of solutions, collisions, and the motions that are lost."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("numba")

from tests.kinematics.arms import Reference, errors
from urdfkit import load
from urdfkit.app.viewer import link_solver
from urdfkit.app.viewer.link_solver import LinkSolver
from urdfkit.errors import KinematicsError, MissingDependencyError
from urdfkit.kinematics import Chain, Kinematics
from urdfkit.view.content.joint_panel import home

TIP = "grasping_frame"
PLANAR = """<robot name="cart"><link name="floor"/><link name="cart"/><link name="upper"/><link name="fore"/>
  <link name="hand"/>
  <joint name="drive" type="planar"><parent link="floor"/><child link="cart"/><axis xyz="0 0 1"/></joint>
  <joint name="a" type="revolute"><parent link="cart"/><child link="upper"/><origin xyz="0 0 0.2"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="b" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
  <joint name="c" type="fixed"><parent link="fore"/><child link="hand"/><origin xyz="0 0 0.3"/></joint>
</robot>"""


@pytest.fixture(scope="module")
def chain() -> Chain:
    link_solver.kernel_is_ready()
    link_solver._loading[0].join()  # compiled once per machine
    return Chain("seven_dof_arm", None, TIP)


@pytest.fixture
def solver(chain: Chain) -> LinkSolver:
    return LinkSolver(chain.robot)


def rest(chain: Chain) -> dict[str, float]:
    return home(Kinematics(chain.robot)) | dict(zip(chain.joint_names, chain.configuration().tolist(), strict=True))


def row(pose: np.ndarray) -> list[float]:
    import pinocchio

    return [*pose[:3, 3].tolist(), *pinocchio.Quaternion(pose[:3, :3]).coeffs().tolist()]


def test_each_solution_has_the_pose_within_the_limits_and_all_differ(chain: Chain, solver: LinkSolver) -> None:
    target = chain.forward(np.random.default_rng(2).uniform(chain.lower, chain.upper))
    answer = solver.answer({"link": TIP, "pose": row(target), "all": True}, rest(chain))
    q = np.array([[one[name] for name in chain.joint_names] for one in answer["solutions"]])
    assert answer["reached"]
    assert len(q) > 3
    distance, angle = errors(Reference(chain).poses(q), np.broadcast_to(target, (len(q), 4, 4)))
    assert distance.max() < 1e-4
    assert angle.max() < 1e-3
    assert (q >= chain.lower).all()
    assert (q <= chain.upper).all()
    differences = np.abs(q[:, None] - q[None]).max(axis=-1) + np.eye(len(q))
    assert differences.min() > link_solver.DISTINCT
    assert np.all(np.diff(np.linalg.norm(q - chain.configuration(), axis=1)) >= 0)


def test_beyond_reach_joints_follow_without_jumps(chain: Chain, solver: LinkSolver) -> None:
    positions = rest(chain)
    moves = []
    for k in range(12):
        pose = [1.2, 0.1 * k, 0.5, 0.0, 0.0, 0.0, 1.0]
        answer = solver.answer({"link": TIP, "pose": pose, "turn": False}, positions)
        (found,) = answer["solutions"]
        assert not answer["reached"]
        assert "beyond reach by" in answer["reason"]
        best = chain.solve(pose, position_only=True).position_error
        assert answer["position_error"] < best + 1e-3
        moves.append(max(abs(found[name] - positions[name]) for name in found))
        positions |= found
    assert max(moves[1:]) < 0.25


def test_other_joints_and_planar_ones_stay(solver: LinkSolver, tmp_path: Path) -> None:
    (tmp_path / "cart.urdf").write_text(PLANAR)
    robot = load(tmp_path / "cart.urdf")
    positions = {"drive/x": 1.0, "drive/y": 2.0, "drive/theta": np.pi / 2, "a": 0.3, "b": 0.5}
    answer = LinkSolver(robot).answer({"link": "hand", "pose": [1, 2.3, 0.6, 0, 0, 0, 1], "turn": False}, positions)
    assert answer["reached"]
    assert set(answer["solutions"][0]) == {"a", "b"}
    placements = Kinematics(robot).placements(Kinematics(robot).configuration(positions | answer["solutions"][0]))
    at = placements[Kinematics(robot).frame("hand")].translation
    np.testing.assert_allclose(at, [1, 2.3, 0.6], atol=1e-4)


def test_a_collision_is_avoided_or_named(chain: Chain, solver: LinkSolver) -> None:
    from urdfkit.kinematics.self_collision.configuration_check import ConfigurationCheck

    check = ConfigurationCheck(chain.robot, chain.joint_names)
    q = np.random.default_rng(0).uniform(chain.lower, chain.upper, (2000, 7))
    hits = q[~check.free(q)]
    start = rest(chain) | dict(zip(chain.joint_names, hits[0].tolist(), strict=True))
    request = {"link": TIP, "pose": row(chain.forward(hits[0]))}
    (same,) = solver.answer(request, start)["solutions"]
    assert np.allclose([same[name] for name in chain.joint_names], hits[0], atol=1e-2)
    answer = solver.answer(request | {"collision_free": True}, start)
    (found,) = answer["solutions"]
    assert bool(check.collisions(found)) == bool(answer["collisions"]) == (not answer["reached"])
    assert not answer["collisions"] or answer["reason"].startswith("collision")


def test_the_lost_motions_are_those_that_no_joints_cause(chain: Chain, solver: LinkSolver) -> None:
    q = chain.configuration(dict.fromkeys(chain.joint_names, 0.0))
    answer = solver.answer({"link": TIP}, rest(chain) | dict.fromkeys(chain.joint_names, 0.0))
    assert answer["solutions"] == []
    assert answer["lost"]
    for lost in answer["lost"]:
        assert np.abs(np.array(lost["direction"]) @ chain.jacobian(q)).max() < 1e-3
        assert lost["words"].endswith("of `world`")
    general = solver.answer({"link": TIP}, rest(chain) | dict(zip(chain.joint_names, [0.3] * 7, strict=True)))
    assert general["lost"] == []


def test_without_numba_the_page_gets_the_command_to_install_it(
    chain: Chain, solver: LinkSolver, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(link_solver, "_failures", [MissingDependencyError("ik needs numba")])
    assert solver.answer({"link": TIP}, rest(chain)) == {"ready": False, "missing": "ik needs numba"}


@pytest.mark.parametrize("link", ["base_link", "nowhere"])
def test_links_that_no_joint_moves_are_refused(chain: Chain, solver: LinkSolver, link: str) -> None:
    with pytest.raises(KinematicsError):
        solver.answer({"link": link}, rest(chain))
