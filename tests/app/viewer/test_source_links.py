"""Which links and joints a place in the source is a part of."""

from pathlib import Path

import pytest

from urdfkit.app.viewer.source_links import SourceLinks
from urdfkit.description import load
from urdfkit.description.xml.source import Span

PARTS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="look" params="size">
    <visual><geometry><box size="${size} 1 1"/></geometry></visual>
  </xacro:macro>
  <xacro:macro name="unused"><link name="never"/></xacro:macro>
</robot>
"""
ROBOT = """<robot name="two" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="parts.xacro"/>
  <link name="a"><xacro:look size="1"/></link>
  <link name="b">
    <xacro:look size="2"/>
  </link>
  <joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint>
</robot>
"""


@pytest.fixture
def source_links(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SourceLinks:
    (tmp_path / "parts.xacro").write_text(PARTS)
    (tmp_path / "two.urdf.xacro").write_text(ROBOT)
    monkeypatch.chdir(tmp_path)  # places may be told from here or from the root
    return SourceLinks(load(tmp_path / "two.urdf.xacro"))


@pytest.mark.parametrize(
    ("file", "line", "column", "expected"),
    [
        ("two.urdf.xacro", 3, 3, [("link", "a", [])]),
        ("two.urdf.xacro", 3, 2, []),
        ("two.urdf.xacro", 5, 5, [("link", "b", [])]),
        ("two.urdf.xacro", 6, 10, []),
        ("two.urdf.xacro", 7, 40, [("joint", "j", [])]),
        ("parts.xacro", 3, 30, [("link", "a", [("look", 3)]), ("link", "b", [("look", 5)])]),
        ("parts.xacro", 2, 3, []),
        ("parts.xacro", 5, 32, []),
        ("elsewhere.xacro", 3, 3, []),
    ],
)
def test_a_place_is_a_part_of_all_that_was_made_of_it(
    source_links: SourceLinks, file: str, line: int, column: int, expected: list
) -> None:
    found = source_links.of(Span(file, line, column, line, column + 1))
    calls = [(what, name, [(call.macro, call.position.line) for call in chain]) for what, name, chain in found]
    assert calls == expected
