"""Links whose mass lies on a line, and what they do in the simulation."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from urdfkit import Simulator
from urdfkit.description import load
from urdfkit.sim.construction.repairs.line_masses import with_thickness

LINE = '<inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="{}"/></inertial>'
BOX = '<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>'
JOINT = (
    '<link name="world"/><joint name="j" type="continuous"><parent link="world"/><child link="a"/>'
    '<origin xyz="0 0 1"/><axis xyz="{}"/></joint>'
)


def robot(tmp_path: Path, izz: float, axis: str = "") -> Path:
    path = tmp_path / "r.urdf"
    joint = JOINT.format(axis) if axis else ""
    path.write_text(f'<robot name="r"><link name="a">{LINE.format(izz)}{BOX}</link>{joint}</robot>')
    return path


@pytest.mark.parametrize("axis", ["", "0 0 1"])
@pytest.mark.parametrize("izz", [0.0, 1e-12, -0.5])
def test_a_mass_on_a_line_is_simulated_with_a_thickness(tmp_path: Path, izz: float, axis: str) -> None:
    simulator = Simulator(robot(tmp_path, izz, axis))
    assert [repair.code for repair in simulator.repairs if "rotation about that axis" in repair.message] == ["I502"]
    inertia = simulator.kinematics.model.inertias[1].inertia
    moments = np.linalg.eigvalsh(inertia)
    assert moments[0] / moments[2] == pytest.approx(0.002, rel=0.01)
    assert moments[1:] == pytest.approx(np.full(2, 1.0 if izz >= 0 else 1.25), rel=0.002)
    simulator.run(1.0)
    assert np.isfinite(simulator.link_poses()).all()


def test_a_mass_on_a_line_stays_where_the_joint_turns_the_line(tmp_path: Path) -> None:
    written = load(robot(tmp_path, 0.0, "0 1 0"))
    assert with_thickness(written, floating=False) == (written, [])


def test_a_rod_with_a_thickness_stays(tmp_path: Path) -> None:
    written = load(robot(tmp_path, 1e-4))
    assert with_thickness(written, floating=True) == (written, [])
