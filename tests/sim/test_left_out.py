"""A mesh in <collision> that is missing or broken: its shape is left out by name, and the rest runs."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.errors import ResourceError
from urdfkit.sim import Simulator

INERTIAL = '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>'
BOX = '<collision><origin xyz="0 0 0.5"/><geometry><box size="1 1 1"/></geometry></collision>'
MESH = '<collision name="hull"><geometry><mesh filename="{}"/></geometry></collision>'


def written(folder: Path, collisions: str) -> Path:
    (folder / "r.urdf").write_text(f'<robot name="r"><link name="base">{INERTIAL}{collisions}</link></robot>')
    (folder / "broken.stl").write_bytes(b"no mesh")
    return folder / "r.urdf"


@pytest.mark.parametrize(("mesh", "said"), [("gone.stl", "no file gone.stl"), ("broken.stl", "is cut off")])
def test_the_shape_is_left_out_by_name_and_the_rest_stands_on_the_ground(tmp_path: Path, mesh: str, said: str) -> None:
    file = written(tmp_path, BOX + MESH.format(mesh))
    notes: list[str] = []
    simulator = Simulator(file, note=notes.append)
    simulator.run(0.3)
    assert simulator.state.base_pose[2] == pytest.approx(0.0, abs=1e-6)
    (note,) = [each for each in notes if mesh in each]
    assert said in note
    assert note.startswith(f"{file}:1:")
    assert note.endswith("shape `base/collision/hull` is left out: nothing touches it there")


def test_a_robot_of_which_nothing_is_left_to_touch_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ResourceError, match=r"gone\.stl"):
        Simulator(written(tmp_path, MESH.format("gone.stl")))


def test_the_command_runs_on(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["sim", "run", str(written(tmp_path, BOX + MESH.format("gone.stl"))), "--for", "0.01"]) == 0
    assert len([line for line in capsys.readouterr().err.splitlines() if "gone.stl" in line]) == 1
