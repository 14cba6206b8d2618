"""`urdfkit completion`: the scripts of the shells, and what they are answered."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

import pytest

from urdfkit.cli import main
from urdfkit.cli.completion import SHELLS


def completions(line: str) -> list[str]:
    """Return what a shell is offered at the end of a command line."""
    reading, writing = os.pipe()
    asked = {
        "_ARGCOMPLETE": "1",
        "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_SHELL": "bash",
        "_ARGCOMPLETE_SUPPRESS_SPACE": "1",
    }
    subprocess.run(
        ["bash", "-c", f'exec 8>&{writing} 9>/dev/null; exec "$@"', "bash", sys.executable, "-m", "urdfkit"],
        env={**os.environ, **asked, "COMP_LINE": line, "COMP_POINT": str(len(line))},
        pass_fds=[writing],
        check=True,
        timeout=60,
    )
    os.close(writing)
    with os.fdopen(reading) as answer:
        return answer.read().split("\n")


@pytest.mark.parametrize(
    ("line", "offered"),
    [
        ("urdfkit vi", ["view"]),
        ("urdfkit sim te", ["teleop"]),
        ("urdfkit view simplet", ["simpleton"]),
        ("urdfkit sim teleop simpleton --world hou", ["house"]),
        ("urdfkit rule I50", [f"I50{k}" for k in range(1, 10)]),
        ("urdfkit new robot scout --drive ", ["diff", "skid", "ackermann", "omni", "none"]),
        ("urdfkit new robot scout --no-gr", ["--no-gripper"]),
    ],
)
def test_a_shell_is_offered_what_may_follow(line, offered):
    assert completions(line) == offered


@pytest.mark.parametrize("shell", SHELLS)
def test_each_shell_gets_a_script_that_it_can_read(shell, capsys):
    assert main(["completion", shell]) == 0
    script = capsys.readouterr().out
    assert "urdfkit" in script
    assert "_ARGCOMPLETE" in script
    if shutil.which(shell):
        subprocess.run([shell, "-n"], input=script, text=True, check=True, timeout=60)


def test_an_unknown_shell_is_one_line(capsys):
    assert main(["completion", "bsh"]) == 2
    assert capsys.readouterr().err.endswith("did you mean `bash`?\n")
    assert main(["completion", "powershell"]) == 2
    assert capsys.readouterr().err.endswith("use bash, zsh or fish\n")
