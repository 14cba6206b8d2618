"""Pictures and films written by ``urdfkit view --image`` and ``--video``."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image

from urdfkit.app.pictures import films
from urdfkit.cli import main

ROBOT = """<robot name="r">
<link name="base"><visual><origin xyz="0 0 -0.3"/><geometry><box size="0.4 0.4 0.4"/></geometry>
<material name="m"><color rgba="0.8 0.1 0.1 1"/></material></visual></link>
<link name="arm"><visual><origin xyz="0 0 0.3"/><geometry><box size="0.1 0.1 0.6"/></geometry></visual></link>
<joint name="j" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="0.5" effort="1" velocity="1"/></joint>
</robot>"""


@pytest.fixture
def robot(tmp_path: Path) -> Path:
    (tmp_path / "robot.urdf").write_text(ROBOT)
    return tmp_path / "robot.urdf"


def view(robot: Path, *words: str) -> int:
    return main(["view", str(robot), "--quiet", *words])


def test_a_picture_shows_the_colours_of_the_robot_on_a_bright_floor(robot: Path, tmp_path: Path) -> None:
    file = tmp_path / "a.png"
    assert view(robot, "--image", str(file), "--size", "96,72") == 0
    rgb = np.asarray(Image.open(file)).astype(int)
    assert rgb.shape == (72, 96, 3)
    assert (rgb[0, 0] > 225).all()
    red = rgb[(rgb[..., 0] > 2 * rgb[..., 1]) & (rgb[..., 0] > 60)]
    assert len(red) > 300
    assert np.ptp(red[:, 0]) > 40  # its sides differ
    assert (rgb.min(axis=-1) >= 255).mean() < 0.01  # nothing is burnt to white
    first = file.read_bytes()
    view(robot, "--image", str(file), "--size", "96,72")
    assert file.read_bytes() == first


def test_a_transparent_picture_has_a_shadow_and_no_background(robot: Path, tmp_path: Path) -> None:
    file = tmp_path / "a.png"
    assert view(robot, "--image", str(file), "--size", "80,80", "--transparent", "--camera", "front") == 0
    rgba = np.asarray(Image.open(file)).astype(int)
    assert rgba.shape == (80, 80, 4)
    assert rgba[0, 0, 3] <= 1
    assert rgba[50, 40].tolist()[3] == 255
    shadow = rgba[(rgba[..., 3] > 20) & (rgba[..., 3] < 200)]
    assert len(shadow) > 50
    assert np.median(shadow[:, :3]) == 0


@pytest.mark.parametrize(("name", "motion"), [("a.gif", "turn"), ("a.webp", "joints"), ("a.png", "joints")])
def test_an_animated_picture(robot: Path, tmp_path: Path, name: str, motion: str) -> None:
    file = tmp_path / name
    assert view(robot, "--video", str(file), "--size", "48,40", "--seconds", "0.4", "--motion", motion) == 0
    pictures = []
    with Image.open(file) as film:
        assert (film.size, film.n_frames) == ((48, 40), 8)
        for k in range(film.n_frames):
            film.seek(k)
            pictures.append(np.asarray(film.convert("RGB")).astype(int))
    assert all(np.abs(a - b).max() > 30 for a, b in pairwise(pictures))


@pytest.mark.parametrize("turn", [0.0, 40.0, 200.0])
def test_all_pictures_of_a_turn_have_the_same_distance_from_the_middle(turn: float) -> None:
    points = np.array([[1.0, 0.0, 0.0], [3.0, 0.0, 0.0], [2.0, 1.0, 0.5]])
    studio = SimpleNamespace(points=lambda pose: points)
    first, frame = (films._turned(studio, np.eye(4), (40, 30), (30.0, 20.0, 2.0), each) for each in (0.0, turn))  # type: ignore[arg-type]
    middle = np.array([2.0, 0.5, 0.25])
    distance = np.linalg.norm(first[:3, 3] - middle)
    assert frame[:3, 3] + distance * frame[:3, 0] == pytest.approx(middle)  # it looks along its x axis


def test_a_joint_moves_to_both_limits_and_back() -> None:
    positions = [films._swept((-1.0, 0.5), 0.0, k / 100) for k in range(101)]
    assert (min(positions), max(positions)) == pytest.approx((-1.0, 0.5))
    assert positions[0] == positions[50] == pytest.approx(positions[100]) == pytest.approx(0.0)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--image", "a.bmp"], "supported: .png .jpg .jpeg .webp"),
        (["--image", "a.jpg", "--transparent"], "JPEG"),
        (["--video", "a.avi"], "supported: .gif .png .webp .mp4 .webm"),
        (["--image", "a.png", "--size", "10"], "--size expects W,H"),
        (["--image", "a.png", "--size", "9,9"], "at least 16"),
        (["--image", "a.png", "--camera", "fornt"], "did you mean `front`?"),
        (["--image", "a.png", "--joint", "k=1"], "`k`"),
        (["--video", "a.gif", "--motion", "jump"], "unknown motion `jump`"),
        (["--video", "a.gif", "--seconds", "0"], "between 0.1 and 60 s"),
        (["--image", "missing/a.png"], "no such folder: missing"),
        (["--image", "a.png", "--seconds", "3"], "--seconds is an option of --video FILE"),
        (["--image", "a.png", "--motion", "joints"], "--motion is an option of --video FILE"),
        (["--video", "a.gif", "--transparent"], "--transparent is an option of --image FILE"),
        (["--seconds", "0"], "--seconds is an option of --video FILE"),
        (["--camera", "top"], "--camera is an option of --image FILE and --video FILE"),
        (["--joint", "j=1"], "--joint is an option of --image FILE and --video FILE"),
        (["--size", "9,9", "--html", "a.html"], "--size is an option of --image FILE and --video FILE"),
        (["--layout", "nolayout.json"], "--layout: no such file: nolayout.json; did you mean `layout.json`?"),
        (["--layout", "a.txt"], "--layout: no such file: a.txt"),
        (["--image", "a.png", "--live", "ros1"], "cannot be combined with --live"),
    ],
)
def test_errors(robot: Path, tmp_path: Path, monkeypatch, capsys, words: list[str], message: str) -> None:
    monkeypatch.chdir(tmp_path)
    Path("layout.json").write_text("{}")
    assert view(robot, *words) == 2
    (line,) = capsys.readouterr().err.strip().splitlines()
    assert message in line


def test_videos_need_ffmpeg(robot: Path, tmp_path: Path, monkeypatch, capsys) -> None:
    monkeypatch.setattr(films.shutil, "which", lambda name: None)
    assert view(robot, "--video", str(tmp_path / "a.mp4")) == 2
    assert "needs the program ffmpeg" in capsys.readouterr().err


def test_the_floor_of_a_picture_shows_no_edges_of_the_many_shadows(robot: Path, tmp_path: Path) -> None:
    file = tmp_path / "a.png"
    assert view(robot, "--image", str(file), "--size", "160,120", "--camera", "60,30,0.5") == 0
    brightness = np.asarray(Image.open(file)).astype(int).sum(axis=-1)
    floor = brightness > 680
    steps = np.abs(np.diff(brightness, axis=1))[floor[:, 1:] & floor[:, :-1]]
    assert len(steps) > 10_000
    assert (steps > 6).sum() < 100  # 2 of 255 in each colour: at the robot and its sun shadow; 637 with 30 directions
