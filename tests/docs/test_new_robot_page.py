"""The tutorial on a robot from nothing: its commands in order, then the workspace that they leave, built for real."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

import pytest

from tests.docs.course import HOME, Step, agrees, blocks, commands
from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.lint import lint

PAGE = Path(__file__).parents[2] / "docs/tutorials/new_robot.md"
SYSTEM = "/usr/sbin:/usr/bin:/sbin:/bin"


def shown() -> list[str]:
    return re.findall(r"^\$ (.+)$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)


@pytest.fixture(scope="module")
def steps(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[Step]]:
    """Type what the page states, but for what serves a page until it is stopped; return the folder and the outputs."""
    folder = tmp_path_factory.mktemp("tutorial").resolve()
    consoles = [block.text for block in blocks(PAGE.read_text(encoding="utf-8")) if block.language == "console"]
    found = []
    here = Path.cwd()
    os.chdir(folder)
    try:
        for command, output in (step for text in consoles for step in commands(text)):
            words = shlex.split(command)
            if words[0] == "urdfkit" and words[1] != "view" and words[1:3] != ["sim", "teleop"]:
                printed = StringIO()
                with redirect_stdout(printed), redirect_stderr(printed):
                    assert main(words[1:]) == 0, command
                found.append(Step(command, output, printed.getvalue().replace(str(folder), HOME)))
    finally:
        os.chdir(here)
    return folder, found


@pytest.fixture(scope="module")
def place(steps: tuple[Path, list[Step]]) -> Path:
    return steps[0]


@pytest.mark.slow
def test_a_reader_sees_the_outputs_of_the_page(steps: tuple[Path, list[Step]]) -> None:
    for step in steps[1]:
        assert agrees(step.shown, step.printed), f"$ {step.command}\n{step.printed}"


@pytest.mark.slow
def test_every_step_is_there(place: Path) -> None:
    reported = " ".join(shown())
    for step in ("new robot", "lint", "view", "new world", "sim teleop", "sim run", "new sensor", "colcon build"):
        assert step in reported
    model = place / "ws/src/scout_description/urdf/scout.urdf.xacro"
    assert {"lidar_link", "camera_link", "rear_lidar_link"} <= set(load(model).link_by_name)
    assert [finding.code for finding in lint([place / "ws/src"]) if finding.severity != "note"] == []


@pytest.mark.slow
def test_the_rear_lidar_sees(place: Path) -> None:
    scan = json.loads((place / "rear.json").read_text())
    assert len(scan["ranges"]) == 541


@pytest.mark.colcon
def test_the_workspace_builds(place: Path) -> None:
    build, source = (command for command in shown() if command.startswith(("cd ws", ". install")))
    done = subprocess.run(
        ["/bin/sh", "-c", f"{build} && {source} && echo $GZ_SIM_RESOURCE_PATH"],
        cwd=place,
        env={"PATH": SYSTEM, "HOME": str(place), "LANG": "C.UTF-8"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert f"{place}/ws/install/scout_description/share" in done.stdout
    assert (place / "ws/install/scout_gazebo/share/scout_gazebo/worlds/lab.sdf").is_file()
    assert (place / "ws/install/scout_bringup/share/scout_bringup/launch/scout.launch.py").is_file()
