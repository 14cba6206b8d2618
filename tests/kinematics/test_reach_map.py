"""Reach maps: solutions by Pinocchio, completeness by many restarts, exact shapes, orientations and threads."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from tests.kinematics.arms import PANDA, UR5, Reference, errors, robot_or_skip
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Chain, ReachMap, reach_map
from urdfkit.kinematics.reach import cone_orientations, down_orientations, uniform_orientations
from urdfkit.kinematics.reach.pose_grid import PoseGrid
from urdfkit.kinematics.self_collision.configuration_check import ConfigurationCheck
from urdfkit.linear_algebra import rotations

BUNDLED = ("seven_dof_arm", "world", "grasping_frame")
ARMS = {"panda": PANDA, "ur5": UR5, "bundled": BUNDLED}
TWO_LINKS = """<robot name="planar"><link name="base"/><link name="upper"/><link name="fore"/><link name="tip"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.7 0 0"/>
    <axis xyz="0 0 1"/></joint>
  <joint name="end" type="fixed"><parent link="fore"/><child link="tip"/><origin xyz="0.4 0 0"/></joint>
</robot>"""


def chain_of(name: str) -> Chain:
    file, base, tip = ARMS[name]
    return Chain(robot_or_skip(file) if isinstance(file, Path) else file, base, tip)


def matrices(found: ReachMap, cells: np.ndarray, turns: np.ndarray) -> np.ndarray:
    """Return poses at the centres of cells (K, 3), which may lie outside the grid; shape (K, 4, 4)."""
    poses = np.tile(np.eye(4), (len(cells), 1, 1))
    poses[:, :3, 3] = found.origin + found.resolution * (cells + 0.5)
    poses[:, :3, :3] = rotations(found.orientations)[turns]
    return poses


@pytest.fixture(scope="module", params=ARMS)
def arm(request: pytest.FixtureRequest) -> tuple[Chain, ReachMap]:
    chain = chain_of(request.param)
    return chain, reach_map(chain, resolution=0.12, orientations=12)


def test_solutions_reach_their_poses_within_limits(arm: tuple[Chain, ReachMap]) -> None:
    chain, found = arm
    where = np.argwhere(found.reached)
    where = where[np.random.default_rng(0).permutation(len(where))[:1500]]
    q = found.q[tuple(where.T)]
    distance, angle = errors(Reference(chain).poses(q), matrices(found, where[:, :3], where[:, 3]))
    assert len(q) == 1500
    assert distance.max() <= 1e-3
    assert angle.max() <= 1.745e-3
    assert ((q >= chain.lower) & (q <= chain.upper)).all()


@pytest.mark.slow
def test_poses_that_many_restarts_reach_are_in_the_map(arm: tuple[Chain, ReachMap]) -> None:
    chain, found = arm
    random = np.random.default_rng(1)
    cells = random.integers(-2, np.array(found.score.shape) + 2, (4000, 3))
    turns = random.integers(0, len(found.orientations), 4000)
    expected = chain.solve(matrices(found, cells, turns), restarts=100, seed=9, approach=False).reached
    inside = ((cells >= 0) & (cells < found.score.shape)).all(axis=1)
    ours = np.zeros(4000, dtype=bool)
    ours[inside] = found.reached[(*cells[inside].T, turns[inside])]
    assert expected.sum() > 200
    assert ours[expected].mean() >= 0.99


def test_score_and_manipulability_are_those_of_the_solutions(arm: tuple[Chain, ReachMap]) -> None:
    chain, found = arm
    np.testing.assert_array_equal(found.score, found.reached.mean(axis=-1))
    best = np.where(found.reached, chain.manipulability(found.q), 0.0).max(axis=-1)
    np.testing.assert_array_equal(found.manipulability, best)
    assert not found.q[~found.reached].any()
    for axis in range(3):  # no empty layers
        layers = found.score.max(axis=tuple({0, 1, 2} - {axis}))
        assert layers[0] > 0.0
        assert layers[-1] > 0.0


@pytest.mark.slow
def test_threads_change_no_bit_and_another_seed_few_poses() -> None:
    chain = chain_of("bundled")
    options = {"resolution": 0.15, "orientations": 10}
    found = [reach_map(chain, threads=threads, **options) for threads in (1, 3)]
    for name in ("origin", "score", "manipulability", "q"):
        assert getattr(found[0], name).tobytes() == getattr(found[1], name).tobytes()
    other = reach_map(chain, seed=1, **options)
    assert other.q.tobytes() != found[0].q.tobytes()
    assert other.reached.sum() == pytest.approx(found[0].reached.sum(), rel=0.01)


@pytest.mark.slow
def test_configurations_without_collisions() -> None:
    chain = chain_of("bundled")
    options = {"resolution": 0.15, "orientations": 8}
    free, every = (reach_map(chain, collision_free=which, **options) for which in (True, False))
    check = ConfigurationCheck(chain.robot, chain.joint_names)
    assert check.free(free.q[free.reached]).all()
    for q in free.q[free.reached][::25]:  # one by one, by the placements of Pinocchio
        assert check.collisions(dict(zip(chain.joint_names, q.tolist(), strict=True))) == ()
    assert 0.5 < free.reached.sum() / every.reached.sum() < 0.95
    # Of the poses that many solutions of inverse kinematics reach without collisions, nearly all are in the map.
    where = np.argwhere(every.reached)
    where = where[np.random.default_rng(2).permutation(len(where))[:150]]
    found = chain.solve(matrices(every, where[:, :3], where[:, 3]), collision_free=True, approach=False).reached
    cells = np.round((every.origin - free.origin) / 0.15).astype(int) + where[:, :3]
    inside = ((cells >= 0) & (cells < free.score.shape)).all(axis=1)
    ours = np.zeros(len(where), dtype=bool)
    ours[inside] = free.reached[(*cells[inside].T, where[inside, 3])]
    assert 80 < found.sum() < 150
    assert ours[found].mean() >= 0.97


def test_positions_of_two_links_fill_their_ring(tmp_path: Path) -> None:
    file = tmp_path / "planar.urdf"
    file.write_text(TWO_LINKS)
    chain = Chain(file, "base", "tip")
    found = reach_map(chain, resolution=0.1, position_only=True)
    assert found.score.shape == (1, 1, 1)  # the plane z = 0 has no centres of cells
    file.write_text(TWO_LINKS.replace('<origin xyz="0.7 0 0"/>', '<origin xyz="0.7 0 0.05"/>'))
    found = reach_map(Chain(file, "base", "tip"), resolution=0.1, position_only=True)
    centres = found.centres()
    radius = np.hypot(centres[..., 0], centres[..., 1])
    np.testing.assert_allclose(centres[..., 2], 0.05, atol=1e-12)
    expected = (radius >= 0.3) & (radius <= 1.1)
    near = (np.abs(radius - 0.3) < 1e-3) | (np.abs(radius - 1.1) < 1e-3)
    assert found.score.shape == (22, 22, 1)
    np.testing.assert_array_equal((found.score == 1.0)[~near], expected[~near])


def test_orientations_are_spread_evenly() -> None:
    found = uniform_orientations(2000)
    np.testing.assert_allclose(np.linalg.norm(found, axis=1), 1.0)
    np.testing.assert_allclose(rotations(found).mean(axis=0), 0.0, atol=2e-3)
    similarity = np.abs(found @ found.T) - 2.0 * np.eye(len(found))
    nearest = 2.0 * np.arccos(similarity.max(axis=1))
    assert nearest.min() > 0.5 * nearest.max()


@pytest.mark.parametrize("tool", [(0, 0, 1), (1, 0, 0), (0.3, -2, 0.5), (0, 0, -1)])
def test_orientations_down_and_in_a_cone_turn_the_tool_axis(tool: tuple[float, float, float]) -> None:
    unit = np.array(tool) / np.linalg.norm(tool)
    down = rotations(down_orientations(8, tool))
    np.testing.assert_allclose(down @ unit, np.tile([0, 0, -1], (8, 1)), atol=1e-12)
    turns = np.sort(np.arccos(np.clip((np.einsum("ij,nij->n", down[0], down) - 1.0) / 2.0, -1, 1)))
    np.testing.assert_allclose(turns[:4], np.array([0, 1, 1, 2]) * math.pi / 4, atol=1e-6)
    axis = np.array([1.0, 2.0, -1.0])
    cone = rotations(cone_orientations(500, axis, 40.0, tool)) @ unit
    angles = np.degrees(np.arccos(cone @ axis / np.linalg.norm(axis)))
    assert angles.max() <= 40.0
    # Evenly on the cap: the part within an angle is the ratio of the areas.
    assert (angles <= 20.0).mean() == pytest.approx(
        (1 - math.cos(math.radians(20))) / (1 - math.cos(math.radians(40))), abs=0.01
    )
    assert np.linalg.norm(np.cross(cone, axis).mean(axis=0)) < 0.05


def test_cells_and_neighbours_of_the_grid() -> None:
    grid = PoseGrid(np.array([-2, 0, 3]), (3, 2, 4), 0.5, uniform_orientations(5))
    np.testing.assert_allclose(grid.origin, [-1.0, 0.0, 1.5])
    cells = np.arange(grid.cells)
    np.testing.assert_array_equal(grid.cell_of(grid.centres(cells) + 0.2), cells)
    poses = np.arange(grid.poses)
    targets = grid.targets(poses)
    steps = set()
    for side in range(6):
        sources, moved = grid.neighbours(poses, side)
        difference = targets[moved] - targets[poses[sources]]
        assert np.abs(difference[:, 3:]).max() == 0.0
        assert len(np.unique(difference.round(9), axis=0)) == 1
        steps.add(tuple(difference[0, :3].round(9).tolist()))
    assert steps == {tuple(s * 0.5 * row) for s in (1, -1) for row in np.eye(3)}


def test_refusals() -> None:
    chain = chain_of("bundled")
    for options, message in (
        ({"resolution": 0.0}, "the resolution is 0 m; it must be above zero"),
        ({"orientations": 0}, "0 orientations: at least one is needed"),
        ({"orientations": [[0, 0, 0, 0]]}, "not zero"),
        ({"orientations": [[1, 0, 0]]}, r"orientations have the shape \(N, 4\); got \(1, 3\)"),
        ({"resolution": 0.005}, "use a coarser resolution than 0.005 m"),
    ):
        with pytest.raises(KinematicsError, match=message):
            reach_map(chain, **options)
    with pytest.raises(KinematicsError, match="the angle must be between 0 and 180"):
        cone_orientations(5, (0, 0, 1), 200.0)
    with pytest.raises(KinematicsError, match="not all zero"):
        cone_orientations(5, (0, 0, 0), 20.0)
