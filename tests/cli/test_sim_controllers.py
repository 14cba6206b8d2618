"""`urdfkit sim run` with controllers: files named, commands published, errors in one line."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from urdfkit.cli import main

OWN = """only:
  type: effort_controllers/JointPositionController
  joint: joint1
  pid: {p: 500.0, i: 200.0, d: 50.0, i_clamp: 60.0}
"""


@pytest.fixture
def run(capsys: pytest.CaptureFixture[str]) -> Callable[..., tuple[int, str, str]]:
    def run(*arguments: Any) -> tuple[int, str, str]:
        code = main(["sim", "run", "rrbot", *map(str, arguments)])
        captured = capsys.readouterr()
        return code, captured.out, captured.err

    return run


def test_a_named_file_takes_the_place_of_the_packages(run: Callable[..., Any], tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(OWN)
    command = "/rrbot/only/command std_msgs/msg/Float64 {data: 0.5}@0"
    code, out, err = run("--for", 12, "--controllers", path, "--topic-pub", command, "--json")
    assert code == 0
    assert json.loads(out)["joints"]["joint1"]["position"] == pytest.approx(0.5, abs=1e-3)
    assert f"controllers of /rrbot: {path}" in err


def test_the_file_that_was_found_is_named(run: Callable[..., Any]) -> None:
    code, _, err = run("--for", 0.1)
    assert code == 0
    assert "rrbot_control.yaml (loaded by" in err
    assert "has no effect" not in err


def test_errors_are_one_line_with_their_place(run: Callable[..., Any], tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(OWN.replace("joint1", "joint_1"))
    wrong, suggestion = f"{path}:3:10: no joint `joint_1` in robot `rrbot`", "; did you mean `joint1`?"
    code, _, err = run("--for", 0.01, "--controllers", path)
    assert code == 0
    assert re.search(f"{re.escape(wrong)}; controller .* is ignored{re.escape(suggestion)}", err)
    code, _, err = run("--for", 1, "--controllers", path, "--strict")
    assert code == 2
    assert wrong + suggestion in err
    code, _, err = run("--for", 1, "--controllers", tmp_path / "none.yaml")
    assert code == 2
    assert "no such file" in err
    assert "Traceback" not in err


def test_an_unused_controller_file_is_reported(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(OWN)
    assert main(["sim", "run", "diff_wheeled_robot", "--for", "0.01", "--controllers", str(path)]) == 0
    reported = capsys.readouterr().err
    assert f"has no plugin that runs controllers: {path} has no effect" in reported
    assert main(["sim", "run", "rrbot", "--for", "0.01", "--controllers", str(path)]) == 0
    assert "has no effect" not in capsys.readouterr().err
