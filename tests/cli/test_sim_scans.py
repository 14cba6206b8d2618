"""``sim run --save-scan``: what is in the file, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from urdfkit.cli import main
from urdfkit.cli.sim import scan_files
from urdfkit.sim.plugins.sensors import cloud_messages

Capture = pytest.CaptureFixture[str]
ROBOT = Path(__file__).parents[2] / "robots/diff_wheeled_robot/diff_wheeled_robot_description/urdf"
LASER = str(ROBOT / "diff_wheeled_robot_with_laser.urdf.xacro")


def saved_by(message: Any) -> tuple[Path, bytes]:
    bus = SimpleNamespace(latest=lambda topic: message)
    (found,) = scan_files.contents(SimpleNamespace(bus=bus, t=0.0), [("/points", Path("x.csv"))])  # type: ignore[arg-type]
    return found


def run(robot: str, *options: str, world: str = "cylinders", seconds: str = "0.1") -> int:
    return main(["sim", "run", robot, "--world", world, "--for", seconds, *(f"--save-scan={each}" for each in options)])


def test_the_last_scan_is_saved_as_json_and_as_a_table(tmp_path: Path) -> None:
    assert run(LASER, f"/scan={tmp_path / 'scan.json'}", str(tmp_path / "scan.csv")) == 0
    found = json.loads((tmp_path / "scan.json").read_text())
    assert (found["topic"], found["frame"], found["time"]) == ("/scan", "hokuyo_link", pytest.approx(0.1))
    assert len(found["angles"]) == len(found["ranges"]) == len(found["intensities"]) == 720
    assert (found["angles"][0], found["angles"][-1]) == pytest.approx((found["angle_min"], found["angle_max"]))
    assert found["ranges"].count(None) not in (0, 720)
    seen = [each for each in found["ranges"] if each is not None]
    assert found["range_min"] <= min(seen) <= max(seen) <= found["range_max"]
    names, *rows = (tmp_path / "scan.csv").read_text().splitlines()
    assert names == "angle,range,intensity"
    table = np.array([row.split(",") for row in rows], dtype=float)
    assert np.array_equal(table[:, 0], found["angles"])
    assert np.array_equal(np.isinf(table[:, 1]), [each is None for each in found["ranges"]])


def test_a_cloud_is_saved_point_by_point(tmp_path: Path) -> None:
    assert (
        run("gem_e2", f"/velodyne_points={tmp_path / 'cloud.json'}", f"velodyne_points={tmp_path / 'cloud.csv'}") == 0
    )
    found = json.loads((tmp_path / "cloud.json").read_text())
    assert found["width"] * found["height"] == len(found["x"]) == len(found["intensity"]) > 100
    names, *rows = (tmp_path / "cloud.csv").read_text().splitlines()
    assert (names, len(rows)) == ("x,y,z,intensity", len(found["x"]))


def test_the_only_cloud_needs_no_topic(tmp_path: Path) -> None:
    assert run("gem_e2", str(tmp_path / "cloud.json")) == 0
    assert json.loads((tmp_path / "cloud.json").read_text())["topic"] == "/velodyne_points"


@pytest.mark.parametrize(
    ("robot", "option", "seconds", "reported"),
    [
        (LASER, "/scn=x.json", "0.1", "--save-scan: unknown topic /scn; did you mean `/scan`?"),
        (LASER, "/scan=x.png", "0.1", "`/scan=x.png` is not TOPIC=FILE.json or .csv"),
        (LASER, "x.json", "0", "--save-scan: no scan was published on /scan in 0 s; increase --for"),
        (
            "simpleton",
            "simpleton/camera1/image_raw=x.json",
            "0",
            "--save-scan: /simpleton/camera1/image_raw carries images, not scans; use --save-image",
        ),
        (
            "simpleton",
            "camera1/image_raw=x.json",
            "0",
            "unknown topic /camera1/image_raw; did you mean `/simpleton/cam",
        ),
        (LASER, "/joint_states=x.json", "0", "/joint_states carries sensor_msgs/msg/JointState, not scans; topics"),
        ("simpleton", "x.json", "0", "select a topic with TOPIC=FILE.json; no topic contains scans"),
    ],
)
def test_an_option_that_cannot_be_saved_is_an_error(
    tmp_path: Path, capsys: Capture, monkeypatch, robot: str, option: str, seconds: str, reported: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(robot, option, seconds=seconds) == 2
    assert reported in capsys.readouterr().err.splitlines()[-1]
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    "option", ["--save-scan=/scan={}.json", "--save-image=/image={}.png", "--save-world={}.sdf", "--record={}.mcap"]
)
def test_places_are_looked_at_before_anything_runs(tmp_path: Path, capsys: Capture, monkeypatch, option: str) -> None:
    monkeypatch.setattr("urdfkit.cli.sim.run_command.load", lambda *_: pytest.fail("the run has started"))
    (tmp_path / "seen").mkdir()
    wrong = option.format(tmp_path / "sene" / "x")
    assert main(["sim", "run", LASER, "--for", "9", f"--save-scan=/scan={tmp_path / 'v.csv'}", wrong]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert f"cannot write {tmp_path}/sene/x." in line
    assert line.endswith(f"no such folder: {tmp_path}/sene; did you mean `{tmp_path}/seen`?")
    (tmp_path / "x.json").mkdir()
    assert main(["sim", "run", LASER, "--for", "9", f"--save-scan={tmp_path / 'x.json'}"]) == 2
    assert capsys.readouterr().err.endswith("x.json is a folder\n")
    assert main(["sim", "run", LASER, "--for", "9", "--record", f"{tmp_path}/x.bag"]) == 2
    assert "recordings are MCAP files; name the file x.mcap" in capsys.readouterr().err
    assert sorted(each.name for each in tmp_path.iterdir()) == ["seen", "x.json"]


def test_the_place_of_a_recording_is_checked_first(tmp_path: Path, capsys: Capture, monkeypatch) -> None:
    monkeypatch.setattr("urdfkit.resources.find_model", lambda *_, **__: pytest.fail("the robot is looked for"))
    assert main(["sim", "teleop", LASER, "--record", f"{tmp_path}/nowhere/x.mcap"]) == 2
    assert f"--record: cannot write {tmp_path}/nowhere/x.mcap: no such folder" in capsys.readouterr().err


def test_nothing_is_written_where_one_has_not_come(tmp_path: Path, capsys: Capture) -> None:
    arguments = ["--world", "void", "--for", "0.07", f"--save-image={tmp_path / 'a.png'}"]  # scans come at 10 Hz
    assert main(["sim", "run", "gem_e2", *arguments, f"--save-scan={tmp_path / 'b.json'}"]) == 2
    assert "--save-scan: no scan was published on /velodyne_points" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_colours_of_points_are_columns() -> None:
    points = {name: np.array([1.0, np.nan]) for name in "xyz"}
    packed = np.array([0x010203, 0xFA8000], dtype=np.uint32).view(np.float32)
    layout = ((*cloud_messages.XYZ, ("rgb", "f4", 16)), 32)
    (file, content) = saved_by(cloud_messages.cloud(0.0, "eye", layout, {**points, "rgb": packed}, width=2))
    assert file == Path("x.csv")
    assert content.decode().splitlines() == ["x,y,z,r,g,b", "1.0,1.0,1.0,1,2,3", "nan,nan,nan,250,128,0"]
