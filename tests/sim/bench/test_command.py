"""The benchmark against other engines as a script and as a person see it."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from typing import Any

import pytest

from tests.bench.peers import memory_use, scenes
from tests.bench.peers.command import THREADS, main
from tests.bench.peers.comparison import Compared, Scaled, Speed
from tests.bench.peers.memory_use import Memory
from tests.bench.peers.report import Report, as_json
from tests.bench.peers.scene import Check, Servo
from tests.bench.peers.scenes import SCENES
from tests.bench.peers.table import table

Capture = pytest.CaptureFixture[str]
QUICK = ("--seconds", "0.001", "--rounds", "1")
FINE, OFF = Check("speed", 0.48, 0.48, 0.024, "m/s"), Check("speed", 0.2, 0.48, 0.024, "m/s")

SHAPE: dict[str, Any] = {
    "dt": float,
    "steps_per_call": int,
    "seconds": float,
    "rounds": int,
    "machine": {"processor": str, "cores": int, "system": str, "python": str, "numba": str, "numpy": str, "pin": str},
    "engines": dict,
    "missing": dict,
    "scenes": list,
    "scaling": (dict, type(None)),
    "memory": (dict, type(None)),
}
SCENE: dict[str, Any] = {"scene": str, "title": str, "engines": dict, "ratios": dict}
ENGINE: dict[str, Any] = {
    "settings": str,
    "right": bool,
    "checks": list,
    "asleep": (int, type(None)),
    "steps_per_cpu_second": {"single": float, "many": float},
    "rounds": {"single": list, "many": list},
    "faster_but_wrong": (dict, type(None)),
}
CHECK: dict[str, Any] = {"what": str, "value": float, "ideal": float, "tolerance": float, "unit": str, "ok": bool}
RATIO: dict[str, Any] = {
    "single": float,
    "many": float,
    "target": (float, type(None)),
    "met": (dict, type(None)),
}
SCALING = {"robots": list, "target": float, "engines": dict}
SCALED = {"settings": str, "right": bool, "microseconds_per_robot": list, "growth": float, "met": bool}
MEMORY = {"robot": str, "world": str, "resident": int, "peak": int, "target": float, "met": bool}


def fits(value: Any, shape: Any) -> None:
    if isinstance(shape, dict):
        assert set(value) == set(shape)
        for key, part in shape.items():
            fits(value[key], part)
    else:
        assert isinstance(value, shape), (value, shape)


def validate(report: dict[str, Any]) -> None:
    fits(report, SHAPE)
    for scene in report["scenes"]:
        fits(scene, SCENE)
        for engine in scene["engines"].values():
            fits(engine, ENGINE)
            for check in engine["checks"]:
                fits(check, CHECK)
            if engine["faster_but_wrong"] is not None:
                fits(engine["faster_but_wrong"], {"settings": str, "steps_per_cpu_second": float, "checks": list})
            for way in ("single", "many"):
                assert len(engine["rounds"][way]) == report["rounds"]
        assert set(scene["ratios"]) == set(scene["engines"]) - {"urdfkit"}
        for ratio in scene["ratios"].values():
            fits(ratio, RATIO)
            assert (ratio["met"] is None) == (ratio["target"] is None)
    if report["scaling"] is not None:
        fits(report["scaling"], SCALING)
        for row in report["scaling"]["engines"].values():
            fits(row, SCALED)
            assert len(row["microseconds_per_robot"]) == len(report["scaling"]["robots"])
    if report["memory"] is not None:
        fits(report["memory"], MEMORY)


def without_peers(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("mujoco", "pybullet"):
        monkeypatch.setitem(sys.modules, name, None)


def example(*, right: bool = True) -> Report:
    """Return a report of one scene with both peers, PyBullet wrong."""
    checks = (FINE if right else OFF,)
    speeds = (
        Speed("urdfkit", "", checks, None, (400e3, 410e3), (500e3, 510e3)),
        Speed("mujoco", "implicitfast CG pyramidal", (FINE,), 0, (200e3, 200e3), (100e3, 100e3)),
        Speed("pybullet", "5 iterations", (OFF,), None, (80e3, 80e3), (81e3, 81e3)),
    )
    rows = (Scaled("urdfkit", "", True, (3e-6, 3e-6, 4.5e-6)), Scaled("mujoco", "implicitfast", True, (4e-6,) * 3))
    machine = {"processor": "abacus", "cores": 1, "system": "x", "python": "3", "numba": "1", "numpy": "2", "pin": "4"}
    versions = {"urdfkit": "0", "mujoco": "4", "pybullet": "3"}
    held = Memory(200_000_000, 260_000_000)
    return Report(machine, versions, {}, 0.3, 2, [Compared(SCENES[0], speeds)], rows, held)


@pytest.mark.slow
def test_the_json_is_of_the_documented_shape(capsys: Capture) -> None:
    pytest.importorskip("mujoco")
    assert main(["--scene", "diff-drive", "--json", *QUICK]) == 0
    report = json.loads(capsys.readouterr().out)
    validate(report)
    (scene,) = report["scenes"]
    assert scene["engines"]["urdfkit"]["right"]
    assert scene["engines"]["Simulator"]["right"]
    assert scene["engines"]["mujoco"]["settings"].split()[0] in ("implicitfast", "Euler", "discrete")
    assert scene["ratios"]["mujoco"]["target"] == 3.0
    assert report["scaling"] is None
    assert report["memory"] is None


def test_a_whole_simulator_is_held_against_the_peers_too() -> None:
    report = example()
    ours, *theirs = report.scenes[0].speeds
    whole = Speed("Simulator", "", (FINE,), None, (300e3, 320e3), (490e3, 500e3))
    text = table(replace(report, scenes=[Compared(SCENES[0], (ours, whole, *theirs))]), width=None)
    (line,) = [line for line in text.splitlines() if "in a Simulator" in line]
    assert line.split()[3:7] == ["310k", "495k", "1.31", "1.02"]
    assert "a Simulator has 1.55 and 4.95 times its speed" in text
    wrong = replace(whole, checks=(OFF,))
    assert not replace(report, scenes=[Compared(SCENES[0], (ours, wrong, *theirs))]).right


def test_the_json_of_every_part_is_of_the_documented_shape() -> None:
    report = json.loads(json.dumps(as_json(example())))
    validate(report)
    ratio = report["scenes"][0]["ratios"]["mujoco"]
    assert ratio == {"single": 2.025, "many": 5.05, "target": 3.0, "met": {"single": False, "many": True}}
    assert report["scaling"]["engines"]["urdfkit"]["microseconds_per_robot"] == pytest.approx([3.0, 3.0, 4.5])
    assert not report["scaling"]["engines"]["urdfkit"]["met"]
    assert report["memory"]["met"]


def test_missing_peers_are_named_and_left_out(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    without_peers(monkeypatch)
    assert main(["--scene", "arm", "--json", *QUICK]) == 0
    out, err = capsys.readouterr()
    report = json.loads(out)
    validate(report)
    assert set(report["missing"]) == {"mujoco", "pybullet"}
    assert report["engines"].keys() == {"urdfkit"}
    for label in ("MuJoCo", "PyBullet"):
        assert (
            f"urdfkit: {label} is not installed and is skipped; install it with pip install 'urdfkit[bench]'"
            in err.splitlines()
        )


def test_progress_is_printed_on_standard_error_unless_quiet(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    without_peers(monkeypatch)
    assert main(["--scene", "diff-drive", *QUICK]) == 0
    out, err = capsys.readouterr()
    assert "diff-drive: measuring" in err
    assert "measuring" not in out
    assert "\x1b" not in out + err
    assert main(["--scene", "diff-drive", "--quiet", *QUICK]) == 0
    assert "measuring" not in capsys.readouterr().err


def test_a_wrong_answer_of_ours_is_something_to_report(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    without_peers(monkeypatch)
    thing = SCENES[3].things[0]
    weak = replace(thing, servos=dict.fromkeys(thing.servos, Servo(2000.0, 60.0, 5.0)))
    monkeypatch.setattr(scenes, "SCENES", (replace(SCENES[3], things=(weak,)),))
    assert main(["--scene", "arm", *QUICK]) == 1
    assert "WRONG: off the pose" in capsys.readouterr().out


def test_scenes_are_listed(capsys: Capture) -> None:
    assert main(["--list"]) == 0
    lines = capsys.readouterr().out.splitlines()
    names = [*(scene.name for scene in SCENES), "scaling", "memory"]
    assert [line.split()[0] for line in lines] == names
    assert main(["--list", "--json"]) == 0
    assert list(json.loads(capsys.readouterr().out)) == names


@pytest.mark.parametrize(
    ("arguments", "reported"),
    [
        (["--scene", "diff-drvie"], "unknown scene `diff-drvie`; did you mean `diff-drive`?"),
        (["--scene", "Memory"], "unknown scene `Memory`; did you mean `memory`?"),
        (["--rounds", "0"], "`0` must be a whole number, one or more"),
        (["--seconds", "-1"], "`-1` must be greater than zero"),
    ],
)
def test_mistakes_are_reported_with_the_nearest_right_name(
    capsys: Capture, arguments: list[str], reported: str
) -> None:
    with pytest.raises(SystemExit, match="2"):
        main(arguments)
    out, err = capsys.readouterr()
    assert out == ""
    assert reported in err.splitlines()[-1]


def test_the_table_shows_each_measurement_with_its_target_and_result() -> None:
    text = table(example(), color="never")
    ours, mujoco, pybullet = (next(line for line in text.splitlines() if label in line) for label in LABELS)
    assert "405k" in ours
    assert "505k" in ours
    assert "right: speed 0.48 of 0.48 m/s" in ours
    assert mujoco.split()[1:5] == ["200k", "100k", "2.02", "5.05"]
    assert "implicitfast CG pyramidal; target 3; right" in mujoco
    assert "WRONG: speed 0.2 of 0.48 m/s" in pybullet
    assert "260 MB (target: under 350)" in text
    assert "grows 1.50 times, target: at most 1.3" in text


LABELS = ("  urdfkit", "  MuJoCo", "  PyBullet")


@pytest.mark.parametrize("width", [60, 80, 100, 140])
def test_a_narrow_terminal_is_not_overrun(width: int) -> None:
    assert max(map(len, table(example(), color="never", width=width).splitlines())) <= width


def test_colours_only_where_they_are_wanted(monkeypatch: pytest.MonkeyPatch) -> None:
    assert "\x1b" not in table(example())
    coloured = table(example(), color="always")
    assert "\x1b[31m" in coloured
    assert "\x1b[32m" in coloured
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.delenv("NO_COLOR", raising=False)
    assert "\x1b" in table(example())
    monkeypatch.setenv("NO_COLOR", "1")
    assert "\x1b" not in table(example())


@pytest.mark.slow
def test_memory_is_that_of_a_fresh_process() -> None:
    found = memory_use.measure()
    assert 20e6 < found.resident <= found.peak < memory_use.MOST


def test_memory_that_cannot_be_measured_is_left_out(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(memory_use.sys, "executable", "/bin/false")
    assert main(["--scene", "memory", "--json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["memory"] is None
    assert "urdfkit: memory is skipped: the process whose memory was to be measured failed" in err


def test_one_thread_is_asked_for(capsys: Capture, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in THREADS:
        monkeypatch.delenv(name, raising=False)
    assert main(["--list"]) == 0
    import os

    assert {os.environ[name] for name in THREADS} == {"1"}
