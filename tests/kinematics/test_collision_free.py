"""Inverse kinematics without collisions, against closed forms of balls on a planar arm."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import cos, dist, hypot, sin
from pathlib import Path

import numpy as np
import pytest

from tests.kinematics.arms import random_configurations
from urdfkit import load
from urdfkit.cli import main
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import ResourceError
from urdfkit.kinematics import Chain
from urdfkit.kinematics.self_collision.collision_free_search import CollisionFreeSearch
from urdfkit.kinematics.self_collision.configuration_check import ConfigurationCheck
from urdfkit.kinematics.serial.serial_chain import SerialChain
from urdfkit.kinematics.serial.serial_solver import SerialSolver, SolverOptions

UPPER, FORE = 0.5, 0.4
POST = (UPPER * cos(0.6), UPPER * sin(0.6))
"""At the elbow of the configuration 0.6, -1.0."""
UP, DOWN = (0.6, -1.0), (0.6 - 2.0 * np.arctan2(FORE * sin(1.0), UPPER + FORE * cos(1.0)), 1.0)
"""Both place the hand at the same point."""


def ball(name: str, x: float, y: float = 0.0, z: float = 0.0) -> str:
    shape = f'<origin xyz="{x!r} {y!r} {z!r}"/><geometry><sphere radius="0.05"/></geometry>'
    return f'<link name="{name}"><collision>{shape}</collision></link>'


def joint(name: str, parent: str, child: str, x: float = 0.0, kind: str = "revolute") -> str:
    limit = '<limit lower="-3" upper="3" effort="1" velocity="1"/>' if kind == "revolute" else ""
    return (
        f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        f'<origin xyz="{x} 0 0"/><axis xyz="0 0 1"/>{limit}</joint>'
    )


def arm_with(*more: str) -> str:
    """Return an arm of two joints with a ball at its elbow and one at its hand, and more links and joints."""
    return (
        f'<robot name="planar">{ball("base", 0.0, 0.0, -1.0)}'
        f'{ball("upper", UPPER)}{ball("fore", FORE)}<link name="hand"/>'
        f"{joint('shoulder', 'base', 'upper')}{joint('elbow', 'upper', 'fore', UPPER)}"
        f"{joint('wrist', 'fore', 'hand', FORE, 'fixed')}{''.join(more)}</robot>"
    )


ONE_POST = arm_with(ball("post", *POST), joint("foot", "base", "post", kind="fixed"))
TWO_POSTS = arm_with(
    *(ball("post", *POST), joint("foot", "base", "post", kind="fixed")),
    *(ball("other", UPPER * cos(DOWN[0]), UPPER * sin(DOWN[0])), joint("other_foot", "base", "other", kind="fixed")),
)
MOVED_POST = arm_with(ball("post", UPPER), joint("foot", "base", "post"))
"""The post turns about the axis of the shoulder; at zero it is at the elbow."""


def hand(q: tuple[float, float]) -> list[float]:
    x = UPPER * cos(q[0]) + FORE * cos(q[0] + q[1])
    return [x, UPPER * sin(q[0]) + FORE * sin(q[0] + q[1]), 0.0, 0.0, 0.0, 0.0, 1.0]


def test_a_solution_with_a_collision_is_replaced(robot_of: Callable[[str], Robot]) -> None:
    chain = Chain(robot_of(ONE_POST), "base", "hand")
    plain = chain.solve(hand(UP), UP, position_only=True)
    np.testing.assert_allclose(plain.q, UP, rtol=0, atol=1e-6)
    assert plain.collisions is None
    free = chain.solve(hand(UP), UP, position_only=True, collision_free=True)
    assert free.reached
    np.testing.assert_allclose(free.q, DOWN, rtol=0, atol=2e-3)
    assert free.collisions == [()]
    every = chain.solve_all(hand(UP), UP, position_only=True, collision_free=True)
    np.testing.assert_allclose(every.q, [DOWN], rtol=0, atol=2e-3)


def test_a_target_whose_solutions_all_collide(robot_of: Callable[[str], Robot]) -> None:
    chain = Chain(robot_of(TWO_POSTS), "base", "hand")
    for found in (
        chain.solve([hand(UP)], UP, position_only=True, collision_free=True),
        chain.solve_all(hand(UP), UP, position_only=True, collision_free=True),
    ):
        assert found.reached.tolist() == [False]
        np.testing.assert_allclose(found.q, [UP], rtol=0, atol=1e-6)
        assert found.position_error[0] < 1e-6
        assert found.collisions == [(("upper", "post"),)]


def test_collisions_are_those_of_the_closed_form(robot_of: Callable[[str], Robot]) -> None:
    chain = Chain(robot_of(ONE_POST), "base", "hand")
    check = ConfigurationCheck(chain.robot, chain.joint_names)
    # Neighbours are ignored; base and post do not move, nor do base and the ball of the upper arm meet.
    assert check.pairs == [("base", "fore"), ("upper", "post"), ("fore", "post")]
    seen = {(): 0, (("upper", "post"),): 0, (("fore", "post"),): 0}
    for a, b in random_configurations(chain, 2000):
        x, y = UPPER * cos(a), UPPER * sin(a)
        tips = {"upper": (x, y), "fore": (x + FORE * cos(a + b), y + FORE * sin(a + b))}
        expected = tuple([(n, "post") for n, (u, v) in tips.items() if hypot(u - POST[0], v - POST[1]) <= 0.1])
        assert check.collisions({"shoulder": a, "elbow": b}) == expected
        seen[expected] = seen.get(expected, 0) + 1
    assert min(seen.values()) >= 10


def test_links_that_collide_at_rest_are_not_checked(robot_of: Callable[[str], Robot]) -> None:
    chain = Chain(robot_of(MOVED_POST), "base", "hand")
    assert ("upper", "post") not in ConfigurationCheck(chain.robot, chain.joint_names).pairs


def test_other_joints_are_held(robot_of: Callable[[str], Robot]) -> None:
    robot = robot_of(arm_with(ball("post", 0.9, 0.3), joint("foot", "base", "post")))
    tip = hand((0.3, 0.4))
    angle = np.arctan2(tip[1], tip[0]) - np.arctan2(0.3, 0.9)
    reach = hypot(0.9, 0.3) - hypot(tip[0], tip[1])
    assert 0.0 < reach < 0.1
    for hold, collides in (({}, False), ({"foot": angle}, True)):
        chain = Chain(robot, "base", "hand", hold=hold)
        assert chain.joint_names == ("shoulder", "elbow")
        found = chain.solve(tip, (0.3, 0.4), position_only=True, collision_free=True)
        assert bool(found.reached) is not collides
        assert found.collisions == [(("fore", "post"),) if collides else ()]


def test_many_targets_in_any_order(robot_of: Callable[[str], Robot]) -> None:
    chain = Chain(robot_of(ONE_POST), "base", "hand")
    check = ConfigurationCheck(chain.robot, chain.joint_names)
    q = np.array([row for row in random_configurations(chain, 500) if not check.collisions(positions(chain, row))])
    targets = chain.forward(q)
    found = chain.solve(targets, UP, position_only=True, collision_free=True)
    assert found.reached.all()
    assert all(not check.collisions(positions(chain, row)) for row in found.q)
    plain = chain.solve(targets, UP, position_only=True)
    assert sum(bool(check.collisions(positions(chain, row))) for row in plain.q) > 5
    backwards = chain.solve(targets[::-1], UP, position_only=True, collision_free=True, threads=1)
    np.testing.assert_array_equal(backwards.q[::-1], found.q)


def positions(chain: Chain, q: np.ndarray) -> dict[str, float]:
    return dict(zip(chain.joint_names, q.tolist(), strict=True))


@pytest.mark.parametrize("prefer", ["nearest", "manipulability"])
def test_the_best_of_the_other_solutions_is_returned(monkeypatch: pytest.MonkeyPatch, prefer: str) -> None:
    chain = SerialChain(load("seven_dof_arm"), "base_link", "grasping_frame")
    search, solver = CollisionFreeSearch(chain), SerialSolver(chain)
    start, target = chain.start(), [0.4, 0.2, 0.4, 0.0, 0.0, 0.0, 1.0]
    options = SolverOptions(prefer=prefer)
    (found,) = solver.solve(target, start, options)
    at_found = list(found.q)
    monkeypatch.setattr(
        search.check, "collisions", lambda positions: (("a", "b"),) if list(positions.values()) == at_found else ()
    )
    best = search.free(found, target, start, options)
    others = [each for each in solver.solve(target, start, SolverOptions(prefer="all"), rows=256) if each.q != found.q]
    assert len(others) > 50
    assert best.reached
    if prefer == "nearest":
        assert dist(best.q, start) == min(dist(each.q, start) for each in others)
    else:
        values = Chain(chain.robot, "base_link", "grasping_frame").manipulability([each.q for each in others])
        assert solver.manipulability(best.q) == pytest.approx(values.max(), abs=1e-12)


def test_a_robot_without_collision_shapes(arm: Robot) -> None:
    chain = Chain(arm, "world", "camera")
    target = chain.forward(chain.configuration())
    free, plain = (chain.solve(target, position_only=True, collision_free=each) for each in (True, False))
    np.testing.assert_array_equal(free.q, plain.q)
    assert free.reached
    assert free.collisions == [()]


def test_a_mesh_that_cannot_be_read(robot_of: Callable[[str], Robot]) -> None:
    chain = Chain(robot_of(ONE_POST.replace('<sphere radius="0.05"/>', '<mesh filename="none.stl"/>')), "base", "hand")
    with pytest.raises(ResourceError, match=r"none\.stl"):
        chain.solve(hand(UP), position_only=True, collision_free=True)


# Command line


@pytest.mark.parametrize("options", [[], ["--all"], ["--prefer", "first"]])
def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str], options: list[str]) -> None:
    x, y = hand(UP)[:2]
    start = ["--position-only", "--from", f"shoulder={UP[0]},elbow={UP[1]}", *options]
    for text, code, collisions in ((ONE_POST, 0, []), (TWO_POSTS, 1, [["upper", "post"]])):
        (tmp_path / "planar.urdf").write_text(text)
        words = ["ik", "-q", str(tmp_path / "planar.urdf"), "hand", "--xyz", f"{x!r},{y!r},0", *start]
        assert main([*words, "--collision-free", "--json"]) == code
        printed = json.loads(capsys.readouterr().out)
        assert printed["reached"] == 1 - code
        (solution,) = printed["solutions"]
        assert solution["collisions"] == collisions
        assert solution["reason"] == ("collision `upper`–`post`" if code else None)
        if code == 0:
            np.testing.assert_allclose(list(solution["positions"].values()), DOWN, rtol=0, atol=2e-3)
        assert main([*words, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["solutions"][0]["collisions"] is None
    assert main([*words, "--collision-free"]) == 1
    assert "hand in base: not reached: collision `upper`–`post`; " in capsys.readouterr().out


def test_command_with_a_file_of_poses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "planar.urdf").write_text(TWO_POSTS)
    np.save(tmp_path / "poses.npy", [hand(UP), hand((-1.0, 1.5)), hand(UP)])
    words = ["ik", "-q", str(tmp_path / "planar.urdf"), "hand", "--targets", str(tmp_path / "poses.npy")]
    words += ["--position-only", "--collision-free", "-o", str(tmp_path / "solutions.npz")]
    assert main(words) == 1
    out = capsys.readouterr().out
    assert out.startswith("hand in base: 1 of 3 poses reached\n")
    assert "2 not reached: collision `upper`–" in out
    assert np.load(tmp_path / "solutions.npz")["reached"].tolist() == [False, True, False]
    assert main([*words, "--json"]) == 1
    found = [solution["collisions"] for solution in json.loads(capsys.readouterr().out)["solutions"]]
    assert found[1] == []
    assert [len(each) for each in found] == [1, 0, 1]


@pytest.mark.parametrize("kind", ["revolute", "planar"])
def test_many_configurations_at_once_collide_as_one_by_one(tmp_path: Path, kind: str) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(arm_with(ball("post", *POST), joint("foot", "base", "post", kind=kind)))
    robot = load(file)
    names = ["shoulder", "elbow", *(["foot"] if kind == "revolute" else ["foot/x", "foot/y", "foot/theta"])]
    check = ConfigurationCheck(robot, names)
    q = np.random.default_rng(4).uniform(-0.4, 0.4, (400, len(names)))
    q[:, 0] += 0.6
    expected = [not check.collisions(dict(zip(names, row.tolist(), strict=True))) for row in q]
    assert 20 < sum(expected) < 380
    np.testing.assert_array_equal(check.free(q), expected)
    assert check.free(q[:0]).shape == (0,)
