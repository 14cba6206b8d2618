"""The quick way to read a command line of ``urdfkit lint`` gives what the parser gives."""

from __future__ import annotations

import pytest

from urdfkit.cli import lint
from urdfkit.cli.lint.fast_arguments import parse_simple
from urdfkit.cli.parser import Parser, add_common


def parsed(words: list[str]) -> dict:
    parser = Parser(prog="urdfkit lint")
    lint.configure(parser)
    add_common(parser)
    return {**vars(parser.parse_args(words)), "command": "lint"}


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["a.urdf"],
        ["a.urdf", "b.xacro", "use_camera:=true"],
        ["-q", "a.urdf", "--no-cache"],
        ["--fix", "--unsafe-fixes", "src", "--diff", "-v"],
        ["--watch", "--no-config", "--statistics", "--quiet", "--verbose"],
    ],
)
def test_paths_and_switches_are_read_as_the_parser_does(words):
    assert vars(parse_simple(words)) == parsed(words)


@pytest.mark.parametrize(
    "words", [["--target", "gz"], ["-h"], ["--fixx"], ["--"], ["-"], ["-qv"], ["--select=I"], ["a", "--jobs", "2"]]
)
def test_all_else_is_the_parsers(words):
    assert parse_simple(words) is None
