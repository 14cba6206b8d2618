"""``sim run --save-scan``: what is in the file, and what is refused."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from urdfkit.cli import main

Capture = pytest.CaptureFixture[str]
ROBOT = Path(__file__).parents[2] / "robots/diff_wheeled_robot/diff_wheeled_robot_description/urdf"
LASER = str(ROBOT / "diff_wheeled_robot_with_laser.urdf.xacro")


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
    ("robot", "option", "seconds", "said"),
    [
        (LASER, "/scn=x.json", "0.1", "--save-scan: no scans come on /scn; did you mean `/scan`?"),
        (LASER, "/scan=x.png", "0.1", "`/scan=x.png` is not TOPIC=FILE.json or .csv"),
        (LASER, "x.json", "0", "--save-scan: no scan came on /scan in 0 s; run for longer"),
        (
            "simpleton",
            "simpleton/camera1/image_raw=x.json",
            "0",
            "--save-scan: pictures come on /simpleton/camera1/image_raw, not scans; save them by --save-image",
        ),
        (
            "simpleton",
            "camera1/image_raw=x.json",
            "0",
            "scans come on /camera1/image_raw; did you mean `/simpleton/cam",
        ),
        (LASER, "/joint_states=x.json", "0", "no scans come on /joint_states, but sensor_msgs/msg/JointState; there"),
        ("simpleton", "x.json", "0", "say which scans, TOPIC=FILE.json; nothing here publishes any"),
    ],
)
def test_what_cannot_be_saved_is_said(
    tmp_path: Path, capsys: Capture, monkeypatch, robot: str, option: str, seconds: str, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(robot, option, seconds=seconds) == 2
    assert said in capsys.readouterr().err.splitlines()[-1]
    assert not list(tmp_path.iterdir())
