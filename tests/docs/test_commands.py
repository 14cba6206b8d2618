"""Every urdfkit command line that README and docs show is run, and prints the output that the page shows."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path

import pytest

from tests.docs import course
from urdfkit.cli import COMMANDS

ROOT = Path(__file__).parents[2]
PAGES = [
    page
    for page in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
    if page not in course.PAGES  # test_courses runs these
]

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


def test_the_table_of_the_readme_has_every_command() -> None:
    rows = re.findall(r"^\| `urdfkit ([a-z]+)", (ROOT / "README.md").read_text("utf-8"), re.MULTILINE)
    assert set(rows) == set(COMMANDS)


@pytest.fixture
def served() -> Iterator[ExitStack]:
    """Yield the stack of the command that serves a page, which runs until the next one of them."""
    with ExitStack() as stack:
        yield stack


@pytest.mark.slow
@pytest.mark.parametrize("page", [p for p in PAGES if shown_commands(p)], ids=lambda p: p.name)
def test_the_commands_on_a_page_work(page: Path, tmp_path: Path, served: ExitStack) -> None:
    (tmp_path / "robot.urdf.xacro").write_text(MODEL)
    words = {word for command, _ in shown_commands(page) for word in command.split()}
    for name in words & {"arm.urdf", "arm.urdf.xacro", "export/arm.urdf"}:
        (tmp_path / name).parent.mkdir(exist_ok=True)
        is_export = name.startswith("export")  # without a mesh, which an import would copy
        text = re.sub("<mesh .*?/>", '<box size="1 1 1"/>', ARM) if is_export else ARM
        (tmp_path / name).write_text(text)
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
        if course.SERVES.search(line):
            served.close()
            course.serve(line, tmp_path, served)
            continue
        refused = re.search(r"^Found |: not reached: ", shown, re.MULTILINE)  # findings, or a pose beyond reach
        printed = course.output(line, tmp_path, (2 if course.REFUSED.match(shown) else int(bool(refused)),))
        if shown.strip():
            assert course.agrees(shown, printed), f"$ {command}\n{printed}"
    assert done
