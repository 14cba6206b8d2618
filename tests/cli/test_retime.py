"""``urdfkit retime``, and ``sim run --trajectory`` with its motion."""

import json

import numpy as np
import pytest

from urdfkit.cli import main

ARM = """<robot name="arm" version="1.2"><link name="world"/>
{links}
<joint name="shoulder" type="revolute"><parent link="world"/><child link="upper"/><axis xyz="0 1 0"/>
  <limit lower="-2" upper="2" velocity="2" effort="100" {extra}/></joint>
<joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/>
  <origin xyz="0 0 0.4"/><axis xyz="0 1 0"/>
  <limit lower="-2" upper="2" velocity="3" effort="100" {extra}/></joint></robot>"""
LINK = """<link name="{}"><inertial><origin xyz="0 0 0.2"/><mass value="1"/>
<inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
PATH = "shoulder,elbow\n0,0\n1,0.5\n0.2,-1\n"


@pytest.fixture
def place(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_arm(tmp_path)
    (tmp_path / "path.csv").write_text(PATH)
    return tmp_path


def write_arm(folder, extra=""):
    links = LINK.format("upper") + LINK.format("lower")
    (folder / "arm.urdf").write_text(ARM.format(links=links, extra=extra))


def retimed(capsys, *words):
    assert main(["retime", "arm.urdf", "path.csv", "--json", *words]) == 0
    return json.loads(capsys.readouterr().out)


def refusal(capsys, *words):
    assert main(list(words)) == 2
    (line,) = capsys.readouterr().err.splitlines()
    return line


def test_limits_come_from_the_command_line_then_moveit_then_the_robot(place, capsys):
    line = refusal(capsys, "retime", "arm.urdf", "path.csv")
    assert "joint `shoulder` has no acceleration limit [rad/s²]" in line
    assert "--acceleration" in line
    write_arm(place, 'acceleration="4" deceleration="3" jerk="50"')
    assert retimed(capsys)["limits"] == {"velocity": [2, 3], "acceleration": [3, 3], "jerk": [50, 50]}
    (place / "package.xml").write_text("<package><name>arm</name></package>")
    (place / "config").mkdir()
    joint = "{has_acceleration_limits: true, max_acceleration: 7.0, has_velocity_limits: false, max_velocity: 9.0}"
    (place / "config/joint_limits.yaml").write_text(f"joint_limits:\n  shoulder: {joint}\n  elbow: {joint}\n")
    assert retimed(capsys)["limits"] == {"velocity": [2, 3], "acceleration": [7, 7], "jerk": [50, 50]}
    chosen = retimed(capsys, "--acceleration", "5,elbow=2", "--jerk", "20", "--scale", "0.5,1")
    assert chosen["limits"] == {"velocity": [1, 1.5], "acceleration": [5, 2], "jerk": [20, 20]}


@pytest.mark.parametrize(
    ("text", "there"),
    [
        ("joint_limits:\n  shoulder_pan: {has_acceleration_limits: true, max_acceleration: 7.0}\n", "`shoulder_pan`"),
        ("shoulder: {limit: {velocity: 1.0}}\n", "no joints"),
    ],
)
def test_a_file_of_limits_without_a_joint_of_the_path_is_refused(place, capsys, text, there):
    (place / "limits.yaml").write_text(text)
    options = ("--joint-limits", "limits.yaml", "--acceleration", "3")
    line = refusal(capsys, "retime", "arm.urdf", "path.csv", *options)
    assert f"limits.yaml limits no joint of the path: it has {there} under `joint_limits`" in line


def test_the_motion_is_written_as_csv_npz_and_json(place, capsys):
    for name in ("m.csv", "m.npz", "m.json"):
        assert main(["retime", "arm.urdf", "path.csv", "--acceleration", "5", "-o", name]) == 0
    assert "wrote m.csv: " in capsys.readouterr().err
    whole = json.loads((place / "m.json").read_text())
    with np.load(place / "m.npz") as arrays:
        assert arrays["positions"].tolist() == whole["positions"]
    header, *rows = (place / "m.csv").read_text().splitlines()
    assert header.split(",")[:4] == ["time", "shoulder", "elbow", "shoulder.velocity"]
    assert len(rows) == len(whole["time"])
    assert [float(word) for word in rows[-1].split(",")[:3]] == pytest.approx([whole["duration"], 0.2, -1.0])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "path.csv: the file is empty"),
        ("0,1\n1,2\n", "path.csv:1: `0` is a number; the first line must contain the names of the joints"),
        ("shoulder,elbo\n0,0\n1,1\n", "no joint `elbo`; did you mean `elbow`?"),
        ("shoulder,elbow\n0,0\n1\n", "path.csv:3: 1 values, but the header has 2 names"),
        ("shoulder,elbow\n0,0\n1,nan\n", "path.csv:3: `nan` of `elbow` is not a finite number"),
        ("shoulder,elbow\n0,0\n1,3\n", "waypoint 2: 3 of joint `elbow` is beyond its limits -2 … 2"),
        ("shoulder,elbow\n0,0\n", "at least two different waypoints"),
        ("time,shoulder,elbow\n0,0,0\n0,1,1\n", "path.csv:3: time 0 s does not increase"),
    ],
)
def test_wrong_paths_are_refused_in_a_line(place, capsys, text, message):
    (place / "path.csv").write_text(text)
    assert message in refusal(capsys, "retime", "arm.urdf", "path.csv", "--acceleration", "5")


@pytest.mark.parametrize("limits", ["5,6", "elbow=1,elbow=2", "=5"])
def test_each_limit_has_one_name(place, capsys, limits):
    line = refusal(capsys, "retime", "arm.urdf", "path.csv", "--acceleration", limits)
    assert f"`{limits.rpartition(',')[2]}` must be VALUE or NAME=VALUE, each name once" in line


def test_a_simulated_robot_follows_the_motion(place, capsys):
    assert main(["retime", "arm.urdf", "path.csv", "--acceleration", "5", "-o", "m.csv"]) == 0
    duration = np.loadtxt("m.csv", delimiter=",", skiprows=1)[-1, 0]
    capsys.readouterr()
    for seconds, words in ((duration / 2, ["--for", f"{duration / 2:.3f}"]), (duration + 0.5, [])):
        assert main(["sim", "run", "arm.urdf", "--trajectory", "m.csv", *words, "--json"]) == 0
        report = json.loads(capsys.readouterr().out)
        assert report["duration"] == pytest.approx(seconds, abs=1e-3)
        joints = report["joints"]
        table = np.loadtxt("m.csv", delimiter=",", skiprows=1)
        for name, column in (("shoulder", 1), ("elbow", 2)):
            wanted = np.interp(seconds, table[:, 0], table[:, column])
            assert joints[name]["position"] == pytest.approx(wanted, abs=1e-3)  # half of a time step of 1 ms
    assert "has no column `time`" in refusal(capsys, "sim", "run", "arm.urdf", "--trajectory", "path.csv")


def test_the_nearest_file_of_a_missing_path_is_suggested(place, capsys):
    (place / "path.csv").write_text("shoulder,elbow\n0,0\n1,1\n")
    assert "no such file: paht.csv; did you mean `path.csv`?" in refusal(capsys, "retime", "arm.urdf", "paht.csv")
