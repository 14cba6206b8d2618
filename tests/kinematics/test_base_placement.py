"""Where to put the base: poses of a known place are reached from there or a better one, by Pinocchio."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("pinocchio")
pytest.importorskip("numba")

from tests.kinematics.arms import Reference, errors
from urdfkit.cli import main
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Chain, base_placement, reach_map
from urdfkit.kinematics.reach import ReachMap


@pytest.fixture(scope="module")
def arm() -> tuple[Chain, ReachMap]:
    chain = Chain("seven_dof_arm", "base_link", "grasping_frame")
    return chain, reach_map(chain, resolution=0.15, orientations=12)


def placed(x: float, y: float, yaw: float) -> np.ndarray:
    pose = np.eye(4)
    pose[:2] = [[np.cos(yaw), -np.sin(yaw), 0, x], [np.sin(yaw), np.cos(yaw), 0, y]]
    return pose


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
def test_poses_that_one_place_reaches_are_reached(arm: tuple[Chain, ReachMap], seed: int) -> None:
    chain, found = arm
    random = np.random.default_rng(seed)
    local = chain.forward(random.uniform(chain.lower, chain.upper, (6, len(chain.lower))))
    poses = placed(1.3, -0.7, 2.0) @ local
    best = base_placement(chain, found, poses)
    assert best.reached.sum() >= 5  # the place itself reaches all six, within centimetres and degrees
    there = placed(best.x, best.y, best.yaw) @ Reference(chain).poses(best.q)
    distance, angle = errors(there, poses)
    assert distance[best.reached].max() <= 1e-3
    assert angle[best.reached].max() <= 1.745e-3


@pytest.mark.slow
def test_command(arm: tuple[Chain, ReachMap], tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = ["x,y,z,qx,qy,qz,qw", "2,3,0.5,0,0,0,1", "2.1,3.1,0.5,0,0,0,1", "9,9,0.5,0,0,0,1"]
    (tmp_path / "poses.csv").write_text("\n".join(rows))
    words = [
        "reach",
        "seven_dof_arm",
        "grasping_frame",
        "--base",
        "base_link",
        "--resolution",
        "0.2",
        "--position-only",
    ]
    code = main([*words, "--base-for", str(tmp_path / "poses.csv"), "--json", "-q"])
    found = json.loads(capsys.readouterr().out)["base_for"]
    assert code == 1  # the third pose is too far from the others
    assert (found["poses"], found["reached"]) == (3, 2)
    assert [one["reached"] for one in found["solutions"]] == [True, True, False]
    x, y, z = found["position"]
    assert np.hypot(x - 2, y - 3) < 1.0
    assert z == 0.0
    tip = placed(x, y, found["yaw"]) @ arm[0].forward(list(found["solutions"][0]["positions"].values()))
    np.testing.assert_allclose(tip[:3, 3], [2, 3, 0.5], atol=1e-3)


def test_poses_that_are_none_are_refused(arm: tuple[Chain, ReachMap]) -> None:
    chain, found = arm
    for poses, message in (
        (np.zeros((2, 6)), r"shape \(N, 7\)"),
        (np.zeros((0, 7)), r"1 to 10000 poses"),
        ([[0, 0, np.nan, 0, 0, 0, 1]], "not finite"),
        ([[0, 0, 0, 0, 0, 0, 1], [0] * 7], "quaternion of pose 1 is zero"),
    ):
        with pytest.raises(KinematicsError, match=message):
            base_placement(chain, found, poses)
