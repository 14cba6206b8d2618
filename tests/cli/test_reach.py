"""`urdfkit reach`: its files, summary and exit status, and how it refuses."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from urdfkit.cli import main
from urdfkit.kinematics import Chain, reach_map
from urdfkit.kinematics.reach import cone_orientations

ARM = ("seven_dof_arm", "grasping_frame", "--resolution", "0.2", "--orientations", "8")


def ran(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Return exit code, standard output and standard error of ``urdfkit reach WORDS``."""
    code = main(["reach", *words])
    out, err = capsys.readouterr()
    return code, out, err


@pytest.mark.slow
def test_the_arrays_are_those_of_python(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "map.npz"
    code, out, err = ran(capsys, *ARM, "--json", "-o", str(file))
    values = json.loads(out)
    assert (code, err.splitlines()[-1]) == (0, f"wrote {file}")  # after a compilation, where nothing is cached
    expected = reach_map(Chain("seven_dof_arm", None, "grasping_frame"), resolution=0.2, orientations=8)
    with np.load(file) as arrays:
        assert (str(arrays["base"]), str(arrays["tip"]), float(arrays["resolution"])) == (
            "world",
            "grasping_frame",
            0.2,
        )
        for name in ("origin", "orientations", "score", "manipulability"):
            np.testing.assert_array_equal(arrays[name], getattr(expected, name))
    assert values["shape"] == list(expected.score.shape)
    assert values["reached"] == expected.reached.sum()
    assert values["cells"] == (expected.score > 0).sum()
    assert values["volume"] == pytest.approx(values["cells"] * 0.008)
    assert values["best"]["score"] == expected.score.max()
    again = tmp_path / "again.npz"
    assert ran(capsys, *ARM, "-q", "-o", str(again))[2] == ""
    assert again.read_bytes() == file.read_bytes()


@pytest.mark.slow
def test_json_and_points_have_the_same_scores(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    for name in ("map.json", "map.ply"):
        assert ran(capsys, *ARM, "-q", "--seed", "3", "-o", str(tmp_path / name))[0] == 0
    values = json.loads((tmp_path / "map.json").read_text())
    score = np.array(values["score"])
    assert values["shape"] == list(score.shape)
    head, _, body = (tmp_path / "map.ply").read_bytes().partition(b"end_header\n")
    kinds = {b"float": "<f4", b"uchar": "u1"}
    rows = [line.split() for line in head.splitlines() if line.startswith(b"property")]
    points = np.frombuffer(body, dtype=[(row[2].decode(), kinds[row[1]]) for row in rows])
    assert len(points) == (score > 0).sum()
    place = np.stack([points["x"], points["y"], points["z"]], axis=1)
    cells = np.round((place - values["origin"]) / values["resolution"] - 0.5).astype(int)
    np.testing.assert_allclose(points["score"], score[tuple(cells.T)], rtol=1e-6)
    np.testing.assert_allclose(points["manipulability"], np.array(values["manipulability"])[tuple(cells.T)], rtol=1e-6)
    assert points["green"][np.argmax(points["score"])] > points["green"][np.argmin(points["score"])]


@pytest.mark.slow
def test_a_cone_about_an_axis_and_the_summary(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    file = tmp_path / "map.npz"
    code, out, err = ran(capsys, *ARM, "--cone", "-z,20", "--tool-axis", "x", "-q", "-o", str(file))
    assert (code, err) == (0, "")
    with np.load(file) as arrays:
        expected = cone_orientations(8, (0, 0, -1), 20.0, (1, 0, 0))
        np.testing.assert_allclose(arrays["orientations"], expected, rtol=0, atol=1e-15)
        cells = int((arrays["score"] > 0).sum())
    lines = out.splitlines()
    assert lines[0] == f"grasping_frame in world: {cells} cells of 0.2 m reached, {cells * 0.008:.3g} m³"
    assert lines[2].startswith("score: share of 8 orientations; mean ")
    code, out, err = ran(capsys, "seven_dof_arm", "shoulder_pitch_link", "--resolution", "0.2")
    assert (code, out) == (1, "shoulder_pitch_link reaches no cell of 0.2 m in world\n")
    assert "2 joints move `shoulder_pitch_link`; with fewer than six it reaches few orientations" in err


@pytest.mark.slow
def test_collisions_lower_the_scores(capsys: pytest.CaptureFixture[str]) -> None:
    every, free = (json.loads(ran(capsys, *ARM, "-q", "--json", *more)[1]) for more in ((), ("--collision-free",)))
    assert 0 < free["reached"] < every["reached"]


def test_refusals(capsys: pytest.CaptureFixture[str]) -> None:
    for words, message in (
        (("--tool-axis", "x"), "reach: --tool-axis requires --down or --cone"),
        (("--cone", "z"), "`z` must be AXIS,DEG with an angle from 0 to 180, such as -z,30"),
        (("--cone", "w,30"), "`w` is not an axis; use x, y, z, -x, -y, -z or X,Y,Z"),
        (("--down", "--position-only"), "not allowed with argument"),
        (("--resolution", "-1"), "`-1` must be greater than zero"),
        (("--resolution", "0.004"), "use a coarser resolution than 0.004 m"),
        (("-o", "map.pyl"), "map.pyl: unsupported file type; use .npz, .json, .ply; did you mean `.ply`?"),
    ):
        try:
            code, out, err = ran(capsys, "seven_dof_arm", "grasping_frame", *words)
        except SystemExit as error:
            code, (out, err) = error.code, capsys.readouterr()
        assert (code, out) == (2, "")
        assert message in err
