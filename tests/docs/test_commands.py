"""Every urdfkit command line that README and docs show is run, and prints the output that the page shows."""

from __future__ import annotations

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


def shown_commands(page: Path) -> list[tuple[str, str]]:
    """Return the urdfkit commands on a page, in order, each with the output that the page shows or an empty text.

    They are the lines after `$` in console blocks, and code spans. A span such as `urdfkit lint` names a command; it is
    not a line to type.
    """
    text = page.read_text(encoding="utf-8")
    found = re.findall(r"^\$ (urdfkit .+)\n((?:(?!\$ |```).*\n)*)|`(urdfkit [^`\n]+)`", text, re.MULTILINE)
    return [
        (line or span, output) for line, output, span in found if line or (len(span.split()) > 2 and "…" not in span)
    ]


def run(command: str, folder: Path, status: int = 0) -> str:
    """Run a command, which must exit with this status; return its output, empty if it serves a page."""
    is_file = {"--image", "--video"} & set(command.split())
    if command.startswith(tuple(f"urdfkit {name}" for name in SERVES)) and not is_file:
        words = [sys.executable, "-m", "urdfkit", *shlex.split(command)[1:], "--no-browser", "--port", "0"]
        with running(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            assert process.stdout is not None
            line = process.stdout.readline()
            process.terminate()
            _, errors = process.communicate(timeout=PATIENCE)
        assert "http://127.0.0.1:" in line, errors
        return ""
    return course.output(command, folder, (status,))


@pytest.mark.slow
@pytest.mark.parametrize("page", [p for p in PAGES if shown_commands(p)], ids=lambda p: p.name)
def test_the_commands_on_a_page_work(page: Path, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf.xacro").write_text(MODEL)
    words = {word for command, _ in shown_commands(page) for word in command.split()}
    for name in words & {"arm.urdf", "arm.urdf.xacro"}:
        (tmp_path / name).write_text(ARM)
    for block in course.blocks(page.read_text(encoding="utf-8")):
        if block.title:
            (tmp_path / block.title).write_text(block.text)
    tables = r"`([\w-]+\.csv)`:\n\n```csv\n(.*?)^```"
    for name, table in re.findall(tables, page.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL):
        (tmp_path / name).write_text(table)
    (tmp_path / "tests").symlink_to(ROOT / "tests")  # pages that name a file of ours speak of a checkout's root
    done = set()
    for command, shown in shown_commands(page):
        if command in done:
            continue
        done.add(command)
        # `new` refuses to overwrite: what it wrote for an earlier line of the page is enough.
        if command.startswith("urdfkit new robot ") and (tmp_path / f"{command.split()[3]}_description").exists():
            continue
        line = f"{command} --yes" if command.startswith("urdfkit new") and "--yes" not in command else command
        status = 2 if course.REFUSED.match(shown) else int("\nFound " in shown)  # an error, findings
        printed = run(line, tmp_path, status)
        if printed and shown.strip():
            assert course.agrees(shown, printed), f"$ {command}\n{printed}"
    assert done
