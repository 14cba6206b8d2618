"""What an editor is told while somebody types is what a fresh look at the same texts finds."""

from __future__ import annotations

import random
import re
from pathlib import Path
from typing import Any

import pytest

from tests.robot_content import content
from urdfkit.description.urdf.parser import parse
from urdfkit.description.xacro.memory import Memory
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source
from urdfkit.errors import XmlError
from urdfkit.lint.editor.open_files import Project
from urdfkit.lint.engine.checker import Checker
from urdfkit.lint.engine.run import merged
from urdfkit.lint.project.options import Options
from urdfkit.resources import find_model, robot_names

PIECES = (
    *(
        "x",
        "1",
        "0.5",
        "-",
        '"',
        "<",
        ">",
        "<!--",
        "-->",
        "${",
        "}",
        "$(arg a)",
        "\n",
        "é",
        " ",
        "/",
        "xacro:",
        "&amp;",
    ),
    *(
        '<link name="q"/>',
        'name="b"',
        '<xacro:property name="zz" value="3"/>',
        "<![CDATA[x]]>",
        "${pi}",
        "\r\n",
        "text",
    ),
)

PLAIN = """<robot name="r">
  <link name="a"/>
  <link name="b"><inertial><mass value="1"/></inertial></link> <!-- end -->
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>
"""


def edited(text: str, dice: random.Random) -> str:
    """Return a text with one change, as somebody types, deletes or pastes."""
    at, kind = dice.randrange(len(text) + 1), dice.random()
    numbers = list(re.finditer(r"\d+", text))
    if kind < 0.4 and numbers:
        one = dice.choice(numbers)
        return text[: one.start()] + str(dice.randrange(10 ** len(one[0]))) + text[one.end() :]
    if kind < 0.7:
        return text[:at] + dice.choice(PIECES) + text[at:]
    if kind < 0.9:
        return text[:at] + text[at + dice.randrange(1, 6) :]
    to = dice.randrange(len(text) + 1)
    return text[:to] + text[at : at + dice.randrange(200)] + text[to:]


def seen(model: Any, findings: Any) -> Any:
    elements = [f"{element!r} {element.origin}" for element in model.robot.element.walk()]
    return [finding.to_json() for finding in findings], content(model.robot), elements, model.expanded.faults


def robots() -> list[str]:
    return robot_names()[:10]


@pytest.mark.slow
@pytest.mark.parametrize("name", robots())
def test_random_edits_are_seen_as_a_fresh_look_sees_them(name: str) -> None:
    path = find_model([name]).path
    dice = random.Random(name)
    files = [file for file in sorted(path.parent.glob("*.xacro")) if file != path]
    changed = dice.choice(files) if files and dice.random() < 0.5 else path
    original = changed.read_text("utf-8")
    project = Project(Options(target="ros2"))
    checker = Checker(Options())
    text = original
    for _ in range(6):
        text = edited(original if dice.random() < 0.3 else text, dice)
        project.set_text(changed, text)
        for entry, analysis in zip(project.entries(path), project.analyses(path), strict=True):
            checker.options = Options(target="ros2", texts={str(changed): text})
            if analysis.model is None:
                continue
            found, model = checker.examine(entry)
            assert seen(analysis.model, analysis.findings) == seen(model, merged(found.findings))


@pytest.mark.parametrize("seed", range(20))
def test_a_plain_text_is_remembered_as_it_is_read(seed: int) -> None:
    dice = random.Random(seed)
    memory, text = Memory(), PLAIN
    for _ in range(30):
        text = edited(PLAIN if dice.random() < 0.2 else text, dice)
        source = Source("a.urdf", text)
        try:
            wanted = document_of(source)
        except XmlError:
            continue
        got = memory.element(source)
        assert [(repr(e), e.origin) for e in got.walk()] == [(repr(e), e.origin) for e in wanted.walk()]
        assert content(parse(got, cached_parts=memory.parts)) == content(parse(wanted))


def test_what_is_not_edited_is_the_same_object() -> None:
    memory = Memory()
    before = memory.element(Source("a.urdf", PLAIN))
    after = memory.element(Source("a.urdf", PLAIN.replace('value="1"', 'value="2"')))
    assert [a is b for a, b in zip(before.children, after.children, strict=True)] == [True, False, True]
    assert after.children[1].find("inertial").find("mass").get("value") == "2"  # type: ignore[union-attr]


def test_an_edit_that_moves_lines_is_read_as_a_whole(tmp_path: Path) -> None:
    memory = Memory()
    memory.element(Source("a.urdf", PLAIN))
    moved = PLAIN.replace('<link name="a"/>', '<link\n name="a"/>')
    assert [e.origin for e in memory.element(Source("a.urdf", moved)).walk()] == [
        e.origin for e in document_of(Source("a.urdf", moved)).walk()
    ]


def test_a_moment_is_reported_once_its_mirrored_part_has_gone(tmp_path: Path) -> None:
    link = (
        '<link name="{}"><inertial><mass value="6"/><inertia ixx="0.1" ixy="{}0.001" ixz="0" iyy="0.01" iyz="0" '
        'izz="0.1"/></inertial><visual><geometry><box size="0.3162 0.3162 0.3162"/></geometry></visual></link>'
    )
    rest = "".join(f'<link name="part_{n}"/>\n' for n in range(8))
    path, project = tmp_path / "arm.urdf", Project(Options(select=("I506",)))
    path.write_text(f'<robot name="arm">\n{link.format("left", "")}\n{link.format("right", "-")}\n{rest}</robot>\n')
    assert [found for found in project.findings(path)[path] if found.code == "I506"] == []
    project.set_text(path, path.read_text("utf-8").replace('"-0.001" ixz="0" iyy="0.01"', '"0" ixz="0" iyy="0.1"'))
    found = [finding for finding in project.findings(path)[path] if finding.code == "I506"]
    assert [finding.link for finding in found] == ["left"]
