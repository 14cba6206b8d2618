"""Sweeps: results agree with closed forms and single runs, on any number of workers, also after a kill."""

from __future__ import annotations

import csv
import json
import logging
import math
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("distributed")
pytest.importorskip("pyarrow")
pytest.importorskip("numba")

from pyarrow import parquet

from tests.processes import kill_group, running
from tests.time_limit import PATIENCE
from urdfkit import sweep
from urdfkit.app.simulation.runs.run_options import RunOptions
from urdfkit.app.sweeps.execution import _client, execute
from urdfkit.app.sweeps.metrics import after, commanded_path
from urdfkit.app.sweeps.scenario import Scenario
from urdfkit.app.sweeps.variations import Interval, SweepRun, combine, parse_variation
from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.description.sdf import load_world
from urdfkit.errors import UrdfkitError
from urdfkit.sim import Simulator, Spawn

MODELS = Path(__file__).parents[2] / "sim" / "fidelity_models"
BOX, SLIDING = MODELS / "box.urdf", Spawn(twist=(2.0, 0.0, 0.0, 0.0, 0.0, 0.0))


@pytest.mark.slow
def test_a_box_slides_as_far_as_friction_and_gravity_let_it(tmp_path: Path) -> None:
    found = sweep(
        BOX,
        vary={"body.mu": "0.4:1:3", "gravity": (9.81, 3.7), "body.mass": [0.5, 4.0]},
        metrics=["x", "speed = highest(vx)", "late = t > 3"],
        duration=4.0,
        until="vx < 1e-6 and t > 0",
        spawn=SLIDING,
        output=tmp_path,
        workers=1,
    )
    assert len(found.rows) == 12
    assert not found.failed
    for row in found.rows:
        assert row["x"] == pytest.approx(2.0**2 / (2.0 * row["body.mu"] * row["gravity"]), rel=1e-4)
        assert row["speed"] == pytest.approx(2.0)
    assert max(found.columns["late"]) == 0.0
    with (tmp_path / "results.csv").open(encoding="utf-8") as stream:
        lines = list(csv.DictReader(stream))
    assert [float(line["x"]) for line in lines] == found.columns["x"]
    assert parquet.read_table(tmp_path / "results.parquet").to_pydict() == found.columns
    assert (tmp_path / "x.png").stat().st_size > 5000
    assert found.summary().splitlines()[0].split() == ["body.mu", "gravity", "body.mass", "x", "speed", "late"]


COMMAND = ("sim", "sweep", str(BOX), "--for", "0.2", "--initial-twist", "2,0,0,0,0,0", "--vary", "body.mu=0.2..1")
COMMAND += ("--seeds", "8", "--metric", "x", "--metric", "e=mean(kinetic_energy)", "--json")


def tables(folder: Path) -> tuple[bytes, bytes]:
    return (folder / "results.csv").read_bytes(), (folder / "results.parquet").read_bytes()


@pytest.mark.slow
def test_killed_and_continued_on_two_workers_it_gives_the_same_table(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    many = (*COMMAND, "--vary", "body.mass=1:3:15")
    assert main([*many, "--workers", "1", "--output", str(tmp_path / "whole")]) == 0
    whole = json.loads(capsys.readouterr().out)
    killed = tmp_path / "killed"
    command = [sys.executable, "-m", "urdfkit", *many, "--output", killed]
    with running([*command, "--workers", "1"], stdout=subprocess.DEVNULL) as process:
        end = time.monotonic() + PATIENCE
        while not (killed / "runs.jsonl").exists() or (killed / "runs.jsonl").read_bytes().count(b"\n") < 20:
            assert process.poll() is None
            assert time.monotonic() < end
            time.sleep(0.01)
        kill_group(process)
    with (killed / "runs.jsonl").open("ab") as stream:
        stream.write(b'{"run": 119, "metr')  # a line that the kill cut off
    assert (killed / "runs.jsonl").read_bytes().count(b"\n") < len(whole)
    done = subprocess.run([*command, "--workers", "2"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout) == whole
    assert tables(killed) == tables(tmp_path / "whole")
    assert (killed / "runs.jsonl").read_bytes().count(b"\n") == len(whole) == 120


def test_a_scheduler_that_cannot_be_reached(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*COMMAND, "--scheduler", "tcp//nowhere", "--output", str(tmp_path)]) == 2
    assert "no Dask scheduler at tcp//nowhere" in capsys.readouterr().err


@pytest.mark.slow
def test_runs_are_continued_only_with_the_same_definition(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    short = [*COMMAND, "--workers", "1", "--output", str(tmp_path)]
    assert main(short) == 0
    before = (tmp_path / "runs.jsonl").stat().st_mtime_ns
    assert main(short) == 0
    assert (tmp_path / "runs.jsonl").stat().st_mtime_ns == before  # nothing was simulated again
    assert main([*short, "--for", "0.3"]) == 2
    assert "has a sweep with other values of duration; use --output" in capsys.readouterr().err
    assert main([*short, "--for", "0.3", "--restart"]) == 0


def test_a_run_that_diverges_is_a_row_with_its_error(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    command = ["sim", "sweep", str(BOX), "--for", "0.1", "--vary", "body.mu=0,1", "--metric", "x", "--json"]
    diverging = ("--initial-twist", "1e170,0,0,0,0,0")
    status = main([*command, *diverging, "--workers", "1", "--output", str(tmp_path)])
    printed = capsys.readouterr()
    rows = json.loads(printed.out)
    assert (status, [row["x"] for row in rows]) == (1, [None, None])
    assert all(row["error"].startswith("the simulation diverged at t = ") for row in rows)
    assert "warning: 2 runs failed; run 0: the simulation diverged" in printed.err


def scenario(model: str | Path, metric: str = "t", **options: object) -> Scenario:
    robots = {(): load(model)}
    return Scenario(robots, {"": load_world("empty")}, RunOptions(**options), 0.1, None, {"m": metric})  # type: ignore[arg-type]


def prepared(model: str | Path, name: str, value: float, **options: object) -> Simulator:
    return scenario(model, **options).prepared(SweepRun(0, 0, {name: value}))[0]


def test_each_parameter_changes_the_simulation() -> None:
    assert prepared(BOX, "spawn.yaw", 0.5).state.base_pose[5] == pytest.approx(math.sin(0.25))
    assert prepared(BOX, "dt", 0.002).dt == 0.002
    arm = MODELS / "damped_flywheel.urdf"
    assert prepared(arm, "spawn.axle", 0.5).state.position("axle") == 0.5
    assert prepared(arm, "axle.damping", 0.25).world.builder.engine.arrays["damping"][0] == 0.25
    driven = prepared("simpleton", "cmd.vx", 0.3, command=(0.1, 0.0, 0.0))
    driven.run(1.0)
    assert driven.state.base_velocity[0] == pytest.approx(0.3, rel=0.05)
    servo = prepared("rrbot", "joint1.p", 7.0)
    from urdfkit.sim.world.live_tuning import Tuning

    assert [gains.p for path, gains in Tuning(servo.world).gains.items() if path.endswith("joint1")] == [7.0]


@pytest.mark.parametrize(
    ("vary", "metric", "message"),
    [
        ("body.mas=1,2", "x", "unknown parameter `body.mas`; did you mean"),
        ("mu=1,2", "x", "unknown parameter `mu`; did you mean `LINK.mu`?"),
        ("bodi.mass=1,2", "x", "no link or model `bodi`; did you mean `body`?"),
        ("body.mass=1,two", "x", "`body.mass` has the value `two`, which is not a number"),
        ("body.mass=1,1", "x", "`body.mass` has the value 1.0 twice"),
        ("body.mass", "x", "`body.mass` is not NAME=VALUES"),
        ("body.mass=-1", "x", "a mass of -1 kg cannot be simulated"),
        ("hinge.damping=1", "x", "no joint `hinge`"),
        ("hinge.p=1", "x", "no controller has gains for `hinge`"),
        ("body.mass=1", "xx", "--metric: `xx` cannot be evaluated: unknown name `xx`"),
        ("body.mass=1", "x +", "--metric: `x +` is not an expression"),
        ("body.mass=1", "highest(x, y)", "needs one expression"),
        ("body.mass=1", "path_error", "add --cmd-vel"),
        ("body.mass=1", "odometry_error", "publishes no odometry"),
    ],
)
def test_mistakes(tmp_path: Path, capsys: pytest.CaptureFixture[str], vary: str, metric: str, message: str) -> None:
    command = ["sim", "sweep", str(BOX), "--for", "0.1", "--vary", vary, "--metric", metric, "--workers", "1"]
    assert main([*command, "--output", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert error.count("\n") == 1


def test_intervals_are_drawn_by_seed_alone() -> None:
    runs = combine({"a": (1.0, 2.0), "b": Interval(3.0, 4.0)}, 3)
    drawn = [run.values["b"] for run in runs]
    assert drawn[:3] == drawn[3:]
    assert len(set(drawn)) == 3
    assert all(3.0 <= float(value) < 4.0 for value in drawn)
    assert parse_variation("a=1:3:5") == ("a", (1.0, 1.5, 2.0, 2.5, 3.0))
    assert parse_variation("world=empty,house") == ("world", ("empty", "house"))


@pytest.mark.parametrize("command", [(0.5, 0.0, 0.0), (0.5, 0.2, -0.7)])
def test_the_commanded_path_is_the_integral_of_the_command(command: tuple[float, float, float]) -> None:
    pose, dt, ramp = (0.0, 0.0, 0.0), 1e-4, 0.5
    for k in range(20_000):
        part = min(1.0, (k + 0.5) * dt / ramp)
        half = 0.5 * dt * part * command[2]
        step = (dt * part * command[0], dt * part * command[1], 2.0 * half)
        pose = after(after(pose, (0.0, 0.0, half)), (step[0], step[1], half))
    assert commanded_path(command, ramp)(2.0) == pytest.approx(pose, abs=1e-7)


@pytest.mark.slow
def test_the_errors_of_path_and_odometry_are_zero_for_ideal_wheels() -> None:
    spawn = Spawn(x=1.0, y=2.0, yaw=0.7)
    found = Scenario(
        {(): load(MODELS / "rover.urdf")},
        {"": load_world("empty")},
        RunOptions(command=(0.3, 0.0, 0.4), ramp=0.5, spawn=spawn),
        2.0,
        None,
        {"path": "highest(path_error)", "odometry": "odometry_error"},
    ).simulate(SweepRun(0, 0, {}))
    assert found.metrics["path"] < 1e-3
    assert found.metrics["odometry"] < 1e-4


def test_an_error_of_the_first_run_comes_before_any_worker(tmp_path: Path) -> None:
    with pytest.raises(UrdfkitError, match="no link or model `x`"):
        sweep(BOX, vary={"x.mass": [1.0]}, metrics=["x"], duration=0.1, output=tmp_path / "none")
    assert not (tmp_path / "none").exists()


def _log_an_error() -> None:
    logging.getLogger("distributed.worker").error("Failed to communicate with scheduler during heartbeat.")


@pytest.mark.slow
def test_what_workers_log_while_they_close_is_not_printed(capfd: pytest.CaptureFixture[str]) -> None:
    with _client(1, None) as client:
        client.run(_log_an_error)
    assert capfd.readouterr() == ("", "")


def _kill_itself(scenario: Scenario, run: SweepRun) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.slow
def test_a_sweep_whose_processes_are_killed_ends_with_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Scenario, "simulate", _kill_itself)
    runs = [SweepRun(number, 0, {}) for number in range(2)]
    with pytest.raises(UrdfkitError, match="a worker process of the sweep was killed"):
        list(execute(None, runs, workers=2, scheduler=None))  # type: ignore[arg-type]
