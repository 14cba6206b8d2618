"""The pre-commit hooks and the GitHub action run commands that there are."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest
import yaml

from urdfkit.cli import format as format_command
from urdfkit.cli import lint
from urdfkit.cli.parser import Parser, add_common

ROOT = Path(__file__).parents[2]


def parsed(words: list[str]):
    command = {"lint": lint, "format": format_command}[words[1]]
    parser = Parser(prog=words[1])
    command.configure(parser)
    add_common(parser)
    return parser.parse_args(words[2:])


def test_hooks_of_pre_commit():
    hooks = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    assert [hook["id"] for hook in hooks] == ["urdfkit-lint", "urdfkit-lint-fix", "urdfkit-format"]
    for hook in hooks:
        options = vars(parsed([*shlex.split(hook["entry"]), "urdf/a.urdf.xacro"]))
        assert options.get("fix", False) is hook["id"].endswith("fix")
        assert re.search(hook["files"], "urdf/a.urdf.xacro")
        assert re.search(hook["files"], "urdf/a.urdf")
        assert not re.search(hook["files"], "a.xacro.py")


def test_the_action_installs_this_checkout_and_annotates():
    file = ROOT / ".github" / "actions" / "lint" / "action.yml"
    action = yaml.safe_load(file.read_text())
    steps = {step.get("name", step.get("uses")): step for step in action["runs"]["steps"]}
    assert action["runs"]["using"] == "composite"
    assert (file.parent / "../../..").resolve() == ROOT
    run = steps["lint"]["run"].replace("$PATHS", "src x:=1").replace("$ARGUMENTS", "--target ros2")
    assert parsed(shlex.split(run)).format == "github"
    used = set(re.findall(r"inputs\.([\w-]+)", file.read_text()))
    assert used == set(action["inputs"])


@pytest.mark.parametrize("code", [0, 1, 2])
def test_findings_do_not_end_the_step_that_writes_sarif(code, tmp_path):
    import subprocess

    action = yaml.safe_load((ROOT / ".github" / "actions" / "lint" / "action.yml").read_text())
    script = next(step["run"] for step in action["runs"]["steps"] if step.get("name") == "sarif")
    fake = tmp_path / "urdfkit"
    fake.write_text(f"#!/bin/sh\necho '{{}}'\nexit {code}\n")
    fake.chmod(0o755)
    environment = {"PATH": f"{tmp_path}:/usr/bin:/bin", "PATHS": ".", "ARGUMENTS": "", "SARIF": "out.sarif"}
    done = subprocess.run(["bash", "-e", "-c", script], cwd=tmp_path, env=environment, check=False)
    assert (done.returncode == 0) is (code < 2)
    assert (tmp_path / "out.sarif").read_text() == "{}\n"
