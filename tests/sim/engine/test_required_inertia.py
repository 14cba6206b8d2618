"""The check of masses visits each joint of a long chain once."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.linear_algebra import vector_norm
from urdfkit.sim.engine.layout import required_inertia


def test_the_check_visits_each_joint_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    tensor = '<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>'
    inertial = f'<inertial><origin xyz="0 0 1"/><mass value="1"/>{tensor}</inertial>'
    links = "".join(f'<link name="l{n}">{inertial}</link>' for n in range(200))
    joints = "".join(
        f'<joint name="j{n}" type="continuous"><parent link="l{n - 1}"/><child link="l{n}"/><axis xyz="0 1 0"/></joint>'
        for n in range(1, 200)
    )
    path = tmp_path / "chain.urdf"
    path.write_text(f'<robot name="chain">{links}{joints}</robot>')
    kinematics = Kinematics(load(path), floating_base=False)
    calls = []
    monkeypatch.setattr(required_inertia, "vector_norm", lambda lever: calls.append(1) or vector_norm(lever))
    required_inertia.require_inertia(kinematics)
    assert len(calls) <= kinematics.model.njoints
