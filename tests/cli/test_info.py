from __future__ import annotations

import json
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.errors import MissingDependencyError

MODEL = """<robot name="arm">
  <link name="base"><inertial><mass value="3"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><box size="2 1 1"/></geometry></visual></link>
  <link name="upper"><inertial><origin xyz="0 0 1"/><mass value="1"/>
    <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <collision><origin xyz="0 0 1"/><geometry><sphere radius="0.5"/></geometry></collision></link>
  <link name="finger"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="1 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="2" velocity="3"/></joint>
  <joint name="grip" type="continuous"><parent link="upper"/><child link="finger"/><mimic joint="shoulder"/></joint>
  <gazebo reference="upper"><sensor name="eye" type="camera"><update_rate>30</update_rate></sensor></gazebo>
  <gazebo><plugin name="d" filename="libgazebo_ros_diff_drive.so">
    <leftJoint>shoulder</leftJoint><rightJoint>grip</rightJoint></plugin></gazebo>
</robot>
"""


@pytest.fixture(autouse=True)
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = Path("arm.urdf")
    path.write_text(MODEL)
    return path


def test_json(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip("pinocchio")
    assert main(["info", str(model), "--json"]) == 0
    captured = capsys.readouterr()
    assert captured.err == ""
    facts = json.loads(captured.out)
    assert facts["robot"] == "arm"
    assert facts["root"] == "base"
    assert facts["links"] == ["base", "upper", "finger"]
    assert [joint["name"] for joint in facts["joints"]] == ["shoulder", "grip"]
    assert facts["joints"][0]["upper"] == 1.0
    assert facts["joints"][1]["mimic"] == "shoulder"
    assert facts["degrees_of_freedom"] == 1
    assert facts["mass"] == 4.0
    (finger,) = facts["estimated_masses"]
    assert finger == {"link": "finger", "joint": "grip", "file": "arm.urdf", "line": 7, "column": 3}
    assert facts["center_of_mass"] == pytest.approx([0.25, 0.0, 0.25])
    assert facts["bounding_box"] == {"min": [-1.0, -0.5, -0.5], "max": pytest.approx([1.5, 0.5, 1.5])}
    assert facts["drives"] == [
        {"kind": "diff_drive", "generation": "ros1", "plugin": "d", "joints": ["shoulder", "grip"]}
    ]
    assert facts["sensors"] == [{"name": "eye", "type": "camera", "on": "upper", "update_rate": 30.0}]


def test_text(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", str(model)]) == 0
    text = capsys.readouterr().out
    lines = dict(line.split(maxsplit=1) for line in text.splitlines() if "  " in line)
    assert lines["links"] == "3, root base"
    assert lines["joints"] == "1 revolute, 1 continuous"
    assert lines["mass"] == "4 kg"
    assert "estimated masses    1 body, in `sim` only: `finger` (arm.urdf:7:3)" in text
    assert lines["sensor"] == "eye (camera) on upper, 30 Hz"


def test_without_pinocchio(model: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def missing(_: str) -> None:
        raise MissingDependencyError("info needs pinocchio: pip install 'urdfkit[view]'")

    monkeypatch.setattr("urdfkit.kinematics.pinocchio_requirement.require_pinocchio", missing)
    assert main(["info", str(model), "--json"]) == 0
    captured = capsys.readouterr()
    facts = json.loads(captured.out)
    assert (facts["mass"], facts["center_of_mass"], facts["bounding_box"]) == (4.0, None, None)
    assert "pip install 'urdfkit[view]'" in captured.err


def test_a_broken_model_is_one_line(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model.write_text(MODEL.replace('child link="finger"', 'child link="fingr"'))
    assert main(["info", str(model), "--strict"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.startswith("urdfkit: arm.urdf:10:")
    assert captured.err.endswith("does not exist; did you mean `finger`?\n")
    assert captured.err.count("\n") == 1


def test_a_negative_mass_and_a_sensor_of_no_link_are_named(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = MODEL.replace('reference="upper"><sensor', 'reference="uper"><sensor').replace(
        '<mass value="1"/>', '<mass value="-1"/>'
    )
    model.write_text(text)
    assert main(["info", str(model)]) == 0
    out = capsys.readouterr().out
    assert "kg of `upper`, which `sim` rejects" in out
    assert "estimated masses" not in out
    assert "eye (camera) on `uper`, which does not exist, 30 Hz" in out
