"""Parts of files and messages on the pages: settings are valid, commands of editors exist, messages are real."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from tests.docs.course import blocks
from urdfkit.cli import main
from urdfkit.lint.engine import settings

DOCS = Path(__file__).parents[2] / "docs"

HAND = """<?xml version="1.0"?>
<robot name="arm">
  <link name="base">
    <inertial><mass value="1"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial>
  </link>
  <joint name="wrist" type="continuous">
    <parent link="base"/>
    <child link="hand"/>
    <origin xyz="0 0 1"/>
    <axis xyz="1 0 0"/>
  </joint>
  <link name="hand">
    <collision><geometry><cylinder radius="0.02" length="0.1"/></geometry></collision>
  </link>
</robot>
"""


def fragment(page: str, language: str) -> str:
    """Return the only block of a page in a language."""
    found = [block.text for block in blocks((DOCS / page).read_text("utf-8")) if block.language == language]
    assert len(found) == 1
    return found[0]


@pytest.mark.parametrize("page", ["linting.md", "formatting.md"])
def test_settings_on_a_page_are_valid(page: str, tmp_path: Path) -> None:
    file = tmp_path / "project/urdfkit.toml"
    for folder in (file.parent, tmp_path / "common_ws/src"):
        folder.mkdir(parents=True)
    (file.parent / "known.json").write_text("{}")
    file.write_text(fragment(page, "toml"))
    assert settings.read(file)


def test_editors_and_assistants_start_commands_that_exist(capsys: pytest.CaptureFixture[str]) -> None:
    toml = pytest.importorskip("tomllib")
    server = toml.loads(fragment("editors.md", "toml"))["language-server"]["urdfkit"]
    formatter = json.loads(fragment("editors.md", "json"))["languages"]["XML"]["formatter"]["external"]
    assistant = json.loads(fragment("mcp.md", "json"))["mcpServers"]["urdfkit"]
    for command, words in (
        (server["command"], server["args"]),
        (formatter["command"], formatter["arguments"]),
        (assistant["command"], assistant["args"]),
    ):
        assert command == "urdfkit"
        with pytest.raises(SystemExit, match="0"):
            main([words[0], "--help"])
        options = [word for word in words[1:] if word.startswith("--")]
        printed = capsys.readouterr().out
        assert all(option in printed for option in options)


def test_the_formatter_keeps_the_lines_that_the_page_excludes(tmp_path: Path) -> None:
    text = (DOCS / "formatting.md").read_text("utf-8")
    [kept] = re.findall("^ *```xml\n(.*?)^ *```", text, re.MULTILINE | re.DOTALL)
    file = tmp_path / "a.urdf"
    file.write_text(f'<robot name="a">\n<link   name="b"/>\n{kept}</robot>\n')
    assert main(["format", str(file)]) == 0
    assert file.read_text() == f'<robot name="a">\n  <link name="b"/>\n{kept}</robot>\n'


@pytest.mark.slow
def test_the_repair_of_a_link_without_a_mass_is_reported_as_on_the_page(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("numba")
    monkeypatch.chdir(tmp_path)
    Path("arm.urdf").write_text(HAND)
    assert main(["sim", "run", "arm.urdf", "--for", "0.01"]) == 0
    assert re.search(re.escape(fragment("physics.md", "text")), capsys.readouterr().err)
