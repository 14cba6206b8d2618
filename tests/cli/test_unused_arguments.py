"""Xacro arguments that no file uses are told on standard error, with the nearest that one does."""

from __future__ import annotations

import pytest

from urdfkit.cli import main
from urdfkit.description.xacro.declared_arguments import unused_arguments
from urdfkit.description.xml.source import Source

TEXT = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg default=""
  name="prefix"/><!-- <xacro:arg name="foo"/> -->
<link name="$(arg prefix)foo"/><xacro:if value="$(eval use_arm and arg('side') == 'left')"/></robot>"""


@pytest.mark.parametrize(
    ("name", "reported"),
    [
        ("prefix", []),
        ("use_arm", []),
        ("side", []),
        ("prefx", ["no file uses the argument `prefx`; did you mean `prefix`?"]),
        ("foo", ["no file uses the argument `foo` (declared: prefix)"]),
    ],
)
def test_what_is_used(name: str, reported: list[str]) -> None:
    assert unused_arguments({name: "1"}, [Source("robot.xacro", TEXT)]) == reported


def test_a_file_without_arguments() -> None:
    assert unused_arguments({"a": "1"}, [Source("robot.urdf", "<robot/>")]) == [
        "no file uses the argument `a`; the robot declares none"
    ]


@pytest.mark.parametrize("command", [["info"], ["tf", "--tree"], ["sim", "run", "--for", "0"]])
def test_every_command_with_a_robot_reports_unused_arguments(
    command: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    words = [*command[: 2 if command[0] == "sim" else 1], "simpleton", "camera_pich:=0.1", *command[2:]]
    words += ["--tree"] if command[0] == "tf" else []
    assert main(words) == 0
    told = "urdfkit: warning: no file uses the argument `camera_pich`; did you mean `camera_pitch`?\n"
    assert told in capsys.readouterr().err
    assert main([*words, "-q"]) == 0
    assert "camera_pich" not in capsys.readouterr().err
