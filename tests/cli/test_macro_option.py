"""A file of macros only: its macros are listed, and `--macro` instantiates one."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import urdfkit
from urdfkit.cli import main
from urdfkit.description.xml.source import Source
from urdfkit.description.xml.start_tag import start_tag
from urdfkit.errors import ModelError, UsageError

MACROS = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:macro name="arm" params="prefix parent:=mount length:=0.5 *origin">
    <link name="${prefix}arm">
      <inertial><mass value="-1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
      <visual><geometry><box size="0.1 0.1 ${length}"/></geometry></visual>
    </link>
    <joint name="${prefix}joint" type="fixed">
      <xacro:insert_block name="origin"/>
      <parent link="${parent}"/><child link="${prefix}arm"/>
    </joint>
  </xacro:macro>
  <xacro:macro name="tool" params="prefix"><link name="${prefix}tool"/></xacro:macro>
</robot>
"""


@pytest.fixture
def macros(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    monkeypatch.chdir(tmp_path)
    Path("arm.xacro").write_text(MACROS)
    return "arm.xacro"


def test_the_macros_of_the_file_are_listed(macros: str) -> None:
    with pytest.raises(ModelError) as caught:
        urdfkit.load(macros)
    assert caught.value.message == (
        "the file defines macros only: `arm` (prefix [parent] [length] *origin), `tool` (prefix); "
        "instantiate one with --macro NAME and its parameters as key:=value"
    )


def test_a_macro_becomes_a_robot_with_the_parent_link_that_it_lacks(macros: str) -> None:
    robot = urdfkit.load(macros, macro="arm", arguments={"prefix": "left_", "length": "0.25"})
    assert robot.name == "arm"
    assert [link.name for link in robot.links] == ["mount", "left_arm"]
    assert robot.links[1].element.origin.position.line == 3
    visual = robot.links[1].visuals[0].element.find("geometry")
    assert visual is not None
    assert visual.children[0].get("size") == "0.1 0.1 0.25"


@pytest.mark.parametrize(
    ("macro", "message"),
    [
        ("arms", r"no macro `arms` in arm.xacro; did you mean `arm`\?"),
        ("gripper", r"no macro `gripper` in arm.xacro; its macros: `arm` \(prefix .*\), `tool` \(prefix\)"),
        ("tool", r"macro `tool` requires `prefix`: pass prefix:=VALUE"),
    ],
)
def test_what_cannot_be_called(macros: str, macro: str, message: str) -> None:
    with pytest.raises(UsageError, match=message):
        urdfkit.load(macros, macro=macro)


def test_an_unknown_parameter_is_named_with_the_nearest(macros: str) -> None:
    with pytest.raises(UsageError, match=r"pass prefix:=VALUE; it has no parameter `prefx`; did you mean `prefix`\?"):
        urdfkit.load(macros, macro="tool", arguments={"prefx": "a", "length": "2"})


def test_tf_of_a_macro(macros: str, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["tf", macros, "prefix:=a_", "mount", "a_arm", "--macro", "arm", "--json"]
    assert main(words) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["translation"] == [0, 0, 0]
    assert err == ""


def test_lint_of_a_macro_places_findings_in_the_file(macros: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lint", macros, "--macro", "arm", "prefix:=a_", "--format", "json", "--no-cache"]) == 1
    findings = json.loads(capsys.readouterr().out)
    assert {found["file"] for found in findings} == {"arm.xacro"}
    assert any("mass" in found["message"] and found["line"] == 4 for found in findings), findings
    assert Path(macros).read_text() == MACROS
    assert main(["lint", macros, "--macro", "arm", "prefix:=a_", "--fix"]) == 2


def test_view_of_a_macro(macros: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["view", macros, "prefix:=a_", "--macro", "arm", "--html", "arm.html"]) == 0
    assert "a_arm" in Path("arm.html").read_text()
    assert "warning: no file uses" not in capsys.readouterr().err


def test_sim_of_a_macro_loads_it(macros: str, capsys: pytest.CaptureFixture[str]) -> None:
    words = ["sim", "run", macros, "prefix:=a_", "--macro", "tool", "--for", "0", "--world", "missing.sdf"]
    assert main(words) == 2
    assert "missing.sdf" in capsys.readouterr().err  # the world is read after the robot


def test_info_and_expand_of_a_macro(macros: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["info", macros, "--macro", "arm", "prefix:=a_", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["links"] == ["mount", "a_arm"]
    assert main(["expand", macros, "--macro", "arm", "prefix:=a_"]) == 0
    out, err = capsys.readouterr()
    assert '<link name="a_arm">' in out
    assert err == ""


def test_expand_compares_no_macro(macros: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["expand", macros, "--macro", "tool", "prefix:=a_", "--compare"]) == 2
    message = "expand: --macro cannot be combined with --compare; xacro has no such option"
    assert capsys.readouterr().err == f"urdfkit: {message}\n"


@pytest.mark.parametrize("text", [MACROS, MACROS.replace("\n", " ").replace("  ", " ")], ids=["lines", "one line"])
@pytest.mark.parametrize("root", ["<robot xmlns", "<robot\n name='r' xmlns"])
def test_every_element_has_a_position_in_the_file_of_the_user(
    macros: str, text: str, root: str, capsys: pytest.CaptureFixture[str]
) -> None:
    text = text.replace("<robot xmlns", root)
    Path(macros).write_text(text)
    source = Source(macros, text)
    robot = urdfkit.load(macros, macro="arm", arguments={"prefix": "p_"})
    macro = source.position(text.index("<xacro:macro"))
    for element in robot.element.walk():
        position = element.origin.position
        tag = start_tag(source, position)
        assert tag is not None
        place = text[source.offset(position.line, position.column) :]
        is_added = element.get("name") == "mount" or element.tag == "origin"
        assert position == macro if is_added else place.startswith(f"<{element.tag}")
        assert [each.position for each in element.origin.expansions if each.macro == "arm"] in ([], [macro])
    assert main(["lint", macros, "--macro", "arm", "prefix:=a_", "--format", "json", "--no-cache"]) == 1
    for finding in json.loads(capsys.readouterr().out):
        assert finding["line"] <= len(source.line_starts)
        assert text[source.offset(finding["line"], finding["column"])] in "<imxnp"


@pytest.mark.parametrize("command", [["view", "--html", "page.html"], ["tf"], ["sim", "run", "--for", "0.01"]])
def test_arguments_that_the_macro_does_not_have_are_reported(
    macros: str, command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("meshcat")
    Path(macros).write_text(MACROS.replace('value="-1"', 'value="1"'))
    words = [*command, macros, "--macro", "arm", "prefix:=a_", "lenght:=2", "origin:=3"]
    assert main(words) == 0
    warnings = [line for line in capsys.readouterr().err.splitlines() if "argument" in line]
    assert warnings == [
        "urdfkit: warning: no file uses the argument `lenght`; did you mean `length`?",
        "urdfkit: warning: no file uses the argument `origin` (declared: prefix, parent, length)",
    ]
    with pytest.raises(UsageError, match="no file uses the argument `lenght`; did you mean `length`"):
        urdfkit.load(macros, macro="arm", arguments={"prefix": "p_", "lenght": "1"})
