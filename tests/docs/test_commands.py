"""Every urdfkit command line that README and docs show, is run."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs import course
from tests.processes import running
from tests.time_limit import PATIENCE

ROOT = Path(__file__).parents[2]
PAGES = [
    page
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    if page not in course.PAGES  # test_courses runs these
]
SERVES = ("view", "sim teleop", "replay")

MODEL = """<?xml version="1.0"?>
<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="$(find simpleton_description)/urdf/simpleton.urdf.xacro"/>
  <link name="base_link"/>
  <joint name="base_link_joint" type="fixed">
    <parent link="chassis"/>
    <child link="base_link"/>
  </joint>
</robot>
"""

ARM = """<?xml version="1.0"?>
<robot name="arm">
  <link name="upper_arm">
    <visual><geometry><mesh filename="meshes/upper_arm.stl"/></geometry></visual>
    <inertial><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/></inertial>
  </link>
</robot>
"""


def shown_commands(page: Path) -> list[str]:
    """Return the urdfkit commands on a page, in order: after `$` in console blocks, and in code spans.

    A span such as `urdfkit lint` names a command; it is not a line to type.
    """
    text = page.read_text(encoding="utf-8")
    found = re.findall(r"^\$ (urdfkit .+)$|`(urdfkit [^`\n]+)`", text, re.MULTILINE)
    return [first or second for first, second in found if first or (len(second.split()) > 2 and "…" not in second)]


def run(command: str, folder: Path) -> None:
    command = command.partition(" | ")[0]  # what follows is no command of urdfkit
    words = [sys.executable, "-m", "urdfkit", *shlex.split(command)[1:]]
    is_file = {"--image", "--video"} & set(words)
    if command.startswith(tuple(f"urdfkit {name}" for name in SERVES)) and not is_file:
        served = [*words, "--no-browser", "--port", "0"]
        with running(served, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            line = process.stdout.readline()
            process.terminate()
            _, errors = process.communicate(timeout=PATIENCE)
        assert "http://127.0.0.1:" in line, errors
        return
    done = subprocess.run(
        words, cwd=folder, capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False, env={**os.environ}
    )
    assert done.returncode == 0, f"{command}\n{done.stdout}{done.stderr}"


@pytest.mark.slow
@pytest.mark.parametrize("page", [p for p in PAGES if shown_commands(p)], ids=lambda p: p.name)
def test_the_commands_on_a_page_work(page: Path, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf.xacro").write_text(MODEL)
    for name in {word for command in shown_commands(page) for word in command.split()} & {"arm.urdf", "arm.urdf.xacro"}:
        (tmp_path / name).write_text(ARM)
    tables = r"`([\w-]+\.csv)`:\n\n```csv\n(.*?)^```"
    for name, table in re.findall(tables, page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(table)
    (tmp_path / "tests").symlink_to(ROOT / "tests")  # pages that name a file of ours speak of a checkout's root
    done = set()
    for command in shown_commands(page):
        if command in done:
            continue
        done.add(command)
        # `new` refuses to overwrite: what it wrote for an earlier line of the page is enough.
        if command.startswith("urdfkit new robot ") and (tmp_path / f"{command.split()[3]}_description").exists():
            continue
        run(f"{command} --yes" if command.startswith("urdfkit new") and "--yes" not in command else command, tmp_path)
    assert done
