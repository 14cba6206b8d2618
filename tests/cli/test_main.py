"""`urdfkit` itself: help, typos, and what happens when something goes wrong underneath."""

from __future__ import annotations

import io
import re

import pytest

import urdfkit
from urdfkit.cli import COMMANDS, main
from urdfkit.cli.unknown_command import OTHER_NAMES


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as stopped:
        main(["--version"])
    assert stopped.value.code == 0
    assert capsys.readouterr().out == f"urdfkit {urdfkit.__version__}\n"


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_helps_with_two_examples_in_80_columns(command: str, capsys, monkeypatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit) as stopped:
        main([command, "--help"])
    assert stopped.value.code == 0
    printed = capsys.readouterr().out
    assert printed.count(f"\n  urdfkit {command}") >= 2
    assert [line for line in printed.splitlines() if len(line) > 80 or re.search(r"\w-$", line)] == []


@pytest.mark.parametrize(("encoding", "errors"), [("ascii", "replace"), ("utf-8", "strict"), ("UTF8", "strict")])
def test_characters_that_a_terminal_lacks_are_replaced(monkeypatch, encoding: str, errors: str) -> None:
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr("sys.stdout", stream)
    assert main(["rule", "I502"]) == 0
    assert stream.errors == errors


def test_a_typo_gets_the_nearest_command(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["lnit"]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.endswith("did you mean `urdfkit lint`?\n")
    assert captured.err.count("\n") == 1


@pytest.mark.parametrize(
    ("word", "meant"),
    [("simulate", "sim"), ("teleop", "sim teleop"), ("telop", "sim teleop"), ("check", "lint"), ("Lint", "lint")]
    + [(word, "format") for word in ("formt", "fromat", "frmat", "formatt", "foramt", "fmt")],
)
def test_a_word_that_is_no_command_names_the_nearest_command(word, meant, capsys):
    assert main([word, "simpleton"]) == 2
    assert capsys.readouterr().err == f"urdfkit: unknown command `{word}`; did you mean `urdfkit {meant}`?\n"


def test_other_names_of_commands_hide_no_command() -> None:
    assert not OTHER_NAMES.keys() & COMMANDS.keys()


def test_a_word_similar_to_no_command_refers_to_the_help(capsys):
    assert main(["quux"]) == 2
    assert capsys.readouterr().err == "urdfkit: unknown command `quux`; `urdfkit --help` lists the commands\n"


def test_a_misspelt_option_gets_the_nearest_one(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tf", "simpleton", "--jsn"]) == 2
    assert "did you mean `--json`?" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("", "pass a command: `urdfkit --help` lists all; try `urdfkit view simpleton`"),
        ("hlep", "unknown command `hlep`; did you mean `urdfkit --help`?"),
        ("help", "unknown command `help`; did you mean `urdfkit --help`?"),
        ("help tf", "unknown command `help`; did you mean `urdfkit tf --help`?"),
        ("simpleton", "unknown command `simpleton`; did you mean `urdfkit view simpleton`?"),
        ("arm.urdf", "unknown command `arm.urdf`; did you mean `urdfkit view arm.urdf`?"),
        ("sim", "sim: pass a subcommand: teleop, run, sweep, warmup"),
        ("sim simpleton", "sim: no subcommand `simpleton`; did you mean `urdfkit sim teleop simpleton`?"),
        ("sim rum simpleton", "sim: no subcommand `rum`; did you mean `run`?"),
        ("sim run simpleton --duration 3", "sim run: unrecognized arguments: --duration 3; did you mean `--for`?"),
        ("topic ecko /odom", "topic: no subcommand `ecko`; did you mean `echo`?"),
        ("lint simpleton --json", "lint: unrecognized arguments: --json; did you mean `--format json`?"),
        ("topic --list", "topic: unrecognized arguments: --list; did you mean `list`?"),
        (
            "view --robot artoo",
            "view: unrecognized arguments: --robot; it is a positional argument: urdfkit view ROBOT",
        ),
        ("view --port 80x", "view: argument --port: `80x` is not an integer"),
        ("expand artoo a=1", "one ROBOT at a time, not 2: artoo a=1; did you mean `a:=1`?"),
        ("completion tcsh", "completion: argument {bash,zsh,fish}: `tcsh` is not available; use bash, zsh or fish"),
        ("new diffdrive", "new: no kind `diffdrive`; use package, robot, world, arm, controllers or sensor"),
    ],
)
def test_a_wrong_command_line_gets_one_line_with_the_nearest_right_one(line, message, capsys):
    assert main(line.split()) == 2
    assert capsys.readouterr().err == f"urdfkit: {message}\n"


def test_a_bug_is_one_line_and_verbose_shows_it(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(arguments: object) -> int:
        raise ZeroDivisionError("division\nby zero")

    monkeypatch.setattr("urdfkit.cli.rule.run", broken)
    assert main(["rule"]) == 2
    line = capsys.readouterr().err
    assert "a bug in urdfkit" in line
    assert line.count("\n") == 1
    with pytest.raises(ZeroDivisionError):
        main(["rule", "-v"])


def test_an_unwritable_place_is_one_line(capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch) -> None:
    def refused(arguments: object) -> int:
        raise PermissionError(13, "Permission denied", "/robots/arm.urdf")

    monkeypatch.setattr("urdfkit.cli.rule.run", refused)
    assert main(["rule"]) == 2
    assert capsys.readouterr().err == "urdfkit: /robots/arm.urdf: Permission denied\n"


def test_a_misspelt_option_is_reported_before_the_missing_argument(capsys):
    assert main(["sim", "run", "simpleton", "--fro", "2"]) == 2
    assert capsys.readouterr().err == "urdfkit: sim run: unrecognized arguments: --fro 2; did you mean `--for`?\n"


def test_an_option_with_a_value_that_it_does_not_take(capsys):
    for word, value in (("-h2", "2"), ("--help=me", "me")):
        assert main(["new", "robot", word]) == 2
        message = f"urdfkit: new robot: argument -h/--help: accepts no value, got `{value}`\n"
        assert capsys.readouterr().err == message
    assert main(["sim", "run", "simpleton"]) == 2
    assert "arguments are required: --for" in capsys.readouterr().err
