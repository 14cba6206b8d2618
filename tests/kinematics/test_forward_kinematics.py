from __future__ import annotations

from pathlib import Path

import numpy as np
import pinocchio as pin
import pytest

from tests.kinematics.random_urdf import random_urdf
from urdfkit.description import load
from urdfkit.description.urdf.robot import Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics import Kinematics, TransformTree, model
from urdfkit.kinematics.pinocchio_model import ForwardKinematics


def star(path: Path, joints: int) -> Path:
    parts = [
        f'<link name="l{i}"/><joint name="j{i}" type="continuous"><parent link="base"/><child link="l{i}"/>'
        f'<origin xyz="0 0 {i}"/><axis xyz="1 0 0"/></joint>'
        for i in range(joints)
    ]
    path.write_text(f'<robot name="star"><link name="base"/>{"".join(parts)}</robot>')
    return path


def test_all_kinds_of_joints_are_placed_as_by_pinocchio(tmp_path: Path, arm: Robot) -> None:
    robots = [arm]
    for seed in range(20):
        (tmp_path / "r.urdf").write_text(random_urdf(seed))
        robots.append(load(tmp_path / "r.urdf"))
    rng = np.random.default_rng(3)
    for robot in robots:
        kinematics = Kinematics(robot, floating_base=bool(rng.integers(2)))
        q = pin.integrate(kinematics.model, kinematics.neutral(), rng.normal(size=kinematics.model.nv))
        expected = kinematics.placements(q)
        found = ForwardKinematics(kinematics.model).placements(q)
        for one, other in zip(found, expected, strict=True):
            np.testing.assert_allclose(one.homogeneous, other.homogeneous, rtol=0.0, atol=1e-12)


def test_poses_of_many_joints_need_no_dense_data(tmp_path: Path) -> None:
    tree = TransformTree(load(star(tmp_path / "r.urdf", model.LARGE + 1)))
    rows = tree.transforms(tree.kinematics.neutral())
    assert [row.translation[2] for row in rows[1:]] == list(range(model.LARGE + 1))
    assert "data" not in vars(tree.kinematics)
    with pytest.raises(KinematicsError, match=r"has 501 degrees of freedom; dynamics are computed for at most 500"):
        _ = tree.kinematics.data


def test_tf_computes_the_poses_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    from urdfkit.cli import main

    passes = []
    original = Kinematics.placements
    monkeypatch.setattr(Kinematics, "placements", lambda self, q: passes.append(1) or original(self, q))
    for joints in (5, 50):
        passes.clear()
        assert main(["tf", str(star(tmp_path / "r.urdf", joints))]) == 0
        assert len(capsys.readouterr().out.splitlines()) == joints + 3
        assert len(passes) == 1
