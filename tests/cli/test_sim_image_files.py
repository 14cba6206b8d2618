"""``sim run --save-image``: contents of the file, and options that are errors."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from urdfkit.app.simulation.image_files import png
from urdfkit.cli import main
from urdfkit.scene.gl.driver_probe import Found
from urdfkit.sim.plugins.sensors.cameras.camera_optics import depth_image, image

Capture = pytest.CaptureFixture[str]
TOPIC = "/simpleton/camera1/image_raw"


@pytest.mark.slow
def test_the_last_picture_is_saved(tmp_path: Path, capsys: Capture) -> None:
    file = tmp_path / "seen.png"
    assert main(["sim", "run", "simpleton", "--world", "house", "--for", "0.1", "--save-image", f"{TOPIC}={file}"]) == 0
    assert "base" in capsys.readouterr().out
    with Image.open(file) as found:
        assert (found.format, found.size, found.mode) == ("PNG", (800, 800), "RGB")
        assert len(np.unique(np.asarray(found).reshape(-1, 3), axis=0)) > 5


@pytest.mark.opengl
@pytest.mark.slow
def test_both_renderers_save_the_same_picture(tmp_path: Path) -> None:
    found = []
    for renderer in ("ray", "gl"):
        file = tmp_path / f"{renderer}.png"
        where = ("--world", "house", "--for", "0.1", "--renderer", renderer)
        assert main(["sim", "run", "simpleton", *where, "--save-image", f"{TOPIC}={file}"]) == 0
        with Image.open(file) as picture:
            found.append(np.asarray(picture).astype(int))
    assert (np.abs(found[0] - found[1]).max(axis=2) <= 3).mean() > 0.99


@pytest.mark.parametrize("called", ["gl", "GL", "opengl", "egl"])
def test_a_renderer_has_several_names(capsys: Capture, monkeypatch, called: str) -> None:
    broken = Found(False, "", "the driver crashed (signal 11)")
    monkeypatch.setattr("urdfkit.scene.renderer.check.__defaults__", (lambda: broken,))
    assert main(["sim", "run", "simpleton", "--for", "0", "--renderer", called]) == 2
    assert "renderer `gl` does not work here" in capsys.readouterr().err


def test_a_renderer_that_there_is_not_is_refused(capsys: Capture) -> None:
    assert main(["sim", "run", "simpleton", "--for", "0", "--renderer", "vulkan"]) == 2
    assert "`vulkan` is not available; use auto, ray or gl" in capsys.readouterr().err


def test_a_renderer_that_does_not_work_is_refused_in_one_line(tmp_path: Path, capsys: Capture, monkeypatch) -> None:
    broken = Found(False, "", "the driver crashed (signal 11)")
    monkeypatch.setattr("urdfkit.scene.renderer.check.__defaults__", (lambda: broken,))
    assert main(["sim", "run", "simpleton", "--for", "0", "--renderer", "gl"]) == 2
    assert "renderer `gl` does not work here: the driver crashed (signal 11)" in capsys.readouterr().err


@pytest.mark.parametrize("encoding", ["rgb8", "bgr8", "mono8", "mono16", "rgb16", "bayer_rggb8"])
def test_pictures_of_every_encoding(tmp_path: Path, encoding: str) -> None:
    rgb = np.random.default_rng(1).integers(0, 256, (6, 10, 3), dtype=np.uint8)
    message = image(0.0, "eye", rgb, encoding)
    found = opened(tmp_path, message)
    if encoding in ("rgb8", "bgr8", "rgb16"):
        assert np.array_equal(found, rgb)
    else:
        kind = "<u2" if encoding == "mono16" else "u1"
        assert np.array_equal(found, message.data.view(kind).reshape(6, 10))


@pytest.mark.parametrize("millimetres", [True, False])
def test_depths_are_millimetres(tmp_path: Path, millimetres: bool) -> None:
    depth = np.array([[0.5, np.nan, 1.2344], [np.inf, 65.0, 65.6]], dtype=np.float32)
    found = opened(tmp_path, depth_image(0.0, "eye", depth, millimetres=millimetres))
    assert found.tolist() == [[500, 0, 1234], [0, 65000, 0]]


def opened(folder: Path, message: Any) -> np.ndarray:
    (folder / "picture.png").write_bytes(png(message))
    with Image.open(folder / "picture.png") as picture:
        return np.asarray(picture)


def test_points_are_saved_otherwise(capsys: Capture) -> None:
    assert main(["sim", "run", "gem_e2", "--for", "0", "--save-image", "/velodyne_points=x.png"]) == 2
    reported = "--save-image: /velodyne_points carries points, not images; use --save-scan"
    assert reported in capsys.readouterr().err.splitlines()[-1]


@pytest.mark.parametrize(
    ("option", "reported"),
    [
        ("/simpleton/camera1/image=x.png", f"unknown topic /simpleton/camera1/image; did you mean `{TOPIC}`?"),
        (f"{TOPIC}=x.jpg", "is not TOPIC=FILE.png"),
        ("x.png", "no image was published on /simpleton/camera1/image_raw in 0 s; increase --for"),
    ],
)
def test_an_option_that_cannot_be_saved_is_an_error(
    tmp_path: Path, capsys: Capture, option: str, reported: str
) -> None:
    option = option.replace("x.png", str(tmp_path / "x.png"))
    assert main(["sim", "run", "simpleton", "--for", "0", "--save-image", option]) == 2
    assert reported in capsys.readouterr().err.splitlines()[-1]
    assert not list(tmp_path.iterdir())
