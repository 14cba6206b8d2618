"""Trying a driver: what works, what crashes, hangs or lies, and who takes pictures then."""

from __future__ import annotations

import sys
from pathlib import Path
from threading import Event

import numpy as np
import pytest

from tests.scene.gl.test_same_picture import table_of, zoo
from tests.scene.test_ray_renderer import lit
from tests.system_packages import missing
from tests.time_limit import PATIENCE
from urdfkit.description.sdf import Light
from urdfkit.errors import SimulationError
from urdfkit.scene import renderer as renderer_module
from urdfkit.scene.camera_model import Lens
from urdfkit.scene.gl import driver_probe as probing
from urdfkit.scene.gl import hanging_driver_record
from urdfkit.scene.gl.driver_probe import Found, on_processor, run_probe
from urdfkit.scene.ray_renderer import RayRenderer
from urdfkit.scene.renderer import check, renderer_of


@pytest.mark.parametrize(
    ("program", "reported"),
    [
        ("import os, signal; os.kill(os.getpid(), signal.SIGSEGV)", "the driver crashed (signal 11)"),
        ("import time; time.sleep(60)", "the driver did not draw a triangle in 0.5 s"),
        ("print('hello')", "the driver test printed no result (exit status 0)"),
        ("raise SystemExit(3)", "the driver test printed no result (exit status 3)"),
        ("print('[1]')", "the driver test printed no result (exit status 0)"),
    ],
)
def test_a_broken_driver_takes_only_its_own_process_down(program: str, reported: str) -> None:
    assert run_probe([sys.executable, "-c", program], seconds=0.5 if "sleep" in program else 30.0) == Found(
        False, "", reported
    )


def test_what_works_is_reported_with_its_name() -> None:
    line = '{"works": true, "backend": "egl", "name": "a card"}'
    assert run_probe([sys.executable, "-c", f"print('chatter'); print('{line}')"]) == Found(True, "egl", "a card")


@pytest.mark.skipif(bool(missing(["opengl"])), reason="Mesa is not installed")
def test_the_software_driver_of_mesa_works(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not marked with `opengl`: tests with that mark are skipped if the probe finds no driver that works."""
    monkeypatch.setenv("LIBGL_ALWAYS_SOFTWARE", "1")
    found = run_probe([sys.executable, "-m", "urdfkit.scene.gl.driver_probe"])
    assert found.works, found.name
    assert on_processor(found.name)


def test_a_program_that_is_not_there() -> None:
    found = run_probe(["/no/such/program"])
    assert not found.works
    assert "cannot start a process" in found.name


def test_a_driver_that_hangs_is_not_tried_again_while_nothing_changes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(hanging_driver_record, "folder", lambda: tmp_path)
    asked: list[int] = []
    found = Found(False, "", "the driver did not draw a triangle in 10 s")

    def run_probe(command: list[str]) -> Found:
        asked.append(len(command))
        return found

    monkeypatch.setattr(probing, "run_probe", run_probe)
    monkeypatch.setattr(probing, "find_spec", lambda name: object())
    plainly, anew = probing.probe.__wrapped__, probing.probe_again.__wrapped__  # without what one process remembers
    monkeypatch.setattr(probing, "probe_again", anew)
    assert plainly() == found
    assert plainly().name == f"{found.name} in the last test; --renderer gl repeats the test"
    assert len(asked) == 1
    monkeypatch.setenv("LIBGL_ALWAYS_SOFTWARE", "true-enough")
    assert plainly() == found
    assert len(asked) == 2
    monkeypatch.setattr(hanging_driver_record, "BELIEVED", 0.0)
    assert plainly() == found
    monkeypatch.undo()
    monkeypatch.setattr(hanging_driver_record, "folder", lambda: tmp_path)
    monkeypatch.setattr(probing, "find_spec", lambda name: object())
    monkeypatch.setattr(probing, "run_probe", lambda command: Found(True, "egl", "a card"))
    assert anew().works
    assert hanging_driver_record.recall() is None


def test_nobody_remembers_where_nothing_can_be_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(hanging_driver_record, "folder", lambda: Path("/dev/null/x"))
    hanging_driver_record.remember("it hung")
    assert hanging_driver_record.recall() is None


def test_a_driver_that_takes_long_is_spoken_of(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(renderer_module, "PATIENCE", 0.0)
    told, notes = Event(), []

    def note(text: str) -> None:
        notes.append(text)
        told.set()

    def slow() -> Found:
        assert told.wait(PATIENCE)
        return Found(True, "no such backend", "llvmpipe")

    renderer_of(table_of(*zoo()), lit(SUN), "auto", note, slow)
    assert notes == ["waiting for the graphics driver, at most 10 s"]


BROKEN = Found(False, "", "the driver crashed (signal 11)")
MISSING = Found(False, "", "moderngl is not installed: pip install 'urdfkit[gl]'")


@pytest.mark.parametrize(
    ("found", "notes"),
    [
        (BROKEN, ["OpenGL does not work here (the driver crashed (signal 11)); images are rendered by ray casting"]),
        (MISSING, []),
        (Found(True, "no such backend", "a card"), ["OpenGL does not work here"]),
    ],
)
def test_rays_take_pictures_where_opengl_does_not(found: Found, notes: list[str]) -> None:
    reported: list[str] = []
    chosen = renderer_of(table_of(*zoo()), lit(), "auto", reported.append, lambda: found)
    assert isinstance(chosen, RayRenderer)
    assert len(reported) == len(notes)
    assert all(line.startswith(note) for line, note in zip(reported, notes, strict=True))


SUN = Light("sun", "directional", cast_shadows=True)


@pytest.mark.parametrize(
    ("renderer", "name", "lights", "rays"),
    [
        ("auto", "llvmpipe (LLVM 15.0.6, 256 bits)", (SUN,), True),
        ("auto", "llvmpipe (LLVM 15.0.6, 256 bits)", (), False),
        ("auto", "NVIDIA H200/PCIe/SSE2", (SUN,), False),
        ("gl", "llvmpipe (LLVM 15.0.6, 256 bits)", (SUN,), False),
    ],
)
def test_the_quicker_one_takes_small_pictures(renderer: str, name: str, lights, rays: bool) -> None:
    reported: list[str] = []
    nowhere = Found(True, "no such backend", name)  # whoever asks for a context is told so, and then casts rays
    chosen = renderer_of(table_of(*zoo()), lit(*lights), renderer, reported.append, lambda: nowhere)
    chosen.take(Lens(300, 200, 1.0), np.eye(4))
    assert (not reported) == rays


def test_a_driver_on_the_processor_starts_with_the_first_large_picture() -> None:
    reported: list[str] = []
    nowhere = Found(True, "no such backend", "llvmpipe (LLVM 15.0.6, 256 bits)")
    chosen = renderer_of(table_of(*zoo()), lit(SUN), "auto", reported.append, lambda: nowhere)
    assert chosen.take(Lens(499, 300, 1.0), np.eye(4)).rgb.shape == (300, 499, 3)
    assert reported == []
    for _ in range(2):
        assert chosen.take(Lens(500, 300, 1.0), np.eye(4)).rgb.shape == (300, 500, 3)
    assert len(reported) == 1
    assert "OpenGL does not work here" in reported[0]


@pytest.mark.parametrize(
    ("name", "processor"),
    [("Apple Software Renderer", True), ("SwiftShader Device", True), ("AMD Radeon Graphics (radeonsi)", False)],
)
def test_names_of_drivers_tell_where_they_draw(name: str, processor: bool) -> None:
    assert on_processor(name) == processor


def test_a_renderer_that_is_forced_and_does_not_work_is_refused() -> None:
    with pytest.raises(SimulationError, match="renderer `gl` does not work here: the driver crashed"):
        check("gl", lambda: BROKEN)
    with pytest.raises(SimulationError, match="unknown renderer `rays`; did you mean `ray`"):
        check("rays")
    check("auto", lambda: BROKEN)
    check("ray", lambda: BROKEN)
