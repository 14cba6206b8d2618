"""The recipes for CI are valid for their services, and their commands report findings and fail where they should."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from tests.docs.course import blocks

ROOT = Path(__file__).parents[2]
GUIDE = {
    block.title: block.text
    for block in blocks((ROOT / "docs/guides/lint_in_ci.md").read_text("utf-8"))
    if block.language in ("yaml", "dockerfile")
}
"""Files of the guide by name."""
ACTION = ROOT / ".github/actions/lint/action.yml"
WORKFLOWS = [
    *sorted((ROOT / ".github/workflows").glob("*.yml")),
    *sorted((ROOT / "templates").rglob(".github/workflows/*.yml")),
]
DEFECT = '<robot name="a">\n  <link name="base"/>\n  <joint name="j" type="fixed">\n    <parent link="bse"/>\n'
DEFECT += '    <child link="arm"/>\n  </joint>\n  <link name="arm"/>\n</robot>\n'


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """Return a folder with a description that has an undefined link on line 4, and a program `urdfkit`."""
    program = tmp_path / "bin" / "urdfkit"
    program.parent.mkdir()
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m urdfkit "$@"\n')
    program.chmod(0o755)
    robot = tmp_path / "checkout" / "src" / "a.urdf"
    robot.parent.mkdir(parents=True)
    robot.write_text(DEFECT)
    return robot.parents[1]


def bash(script: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """Run a step as the runner of GitHub does: bash, ending at the first error."""
    path = f"{folder.parent / 'bin'}{os.pathsep}{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "PYTHONPATH": str(ROOT), "CI": "true", **variables}
    words = ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script]
    return subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, check=False)


@pytest.mark.slow
def test_files_match_the_schemas_of_their_services(tmp_path: Path) -> None:
    pytest.importorskip("check_jsonschema")
    checked = {"vendor.github-actions": [ACTION], "vendor.github-workflows": [*WORKFLOWS], "vendor.gitlab-ci": []}
    for name, kind in ((".github/workflows/lint.yml", "github-workflows"), (".gitlab-ci.yml", "gitlab-ci")):
        file = tmp_path / Path(name).name
        file.write_text(GUIDE[name])
        checked[f"vendor.{kind}"].append(file)
    for schema, files in checked.items():
        words = [sys.executable, "-m", "check_jsonschema", "--builtin-schema", schema, *map(str, files)]
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_the_steps_of_the_action_annotate_the_line_of_a_finding(repository: Path) -> None:
    steps = {step.get("name"): step for step in yaml.safe_load(ACTION.read_text())["runs"]["steps"]}
    inputs = {"PATHS": "src", "ARGUMENTS": "--target ros2", "SARIF": "lint.sarif"}
    assert bash(steps["sarif"]["run"], repository, **inputs).returncode == 0
    [result] = json.loads((repository / "lint.sarif").read_text())["runs"][0]["results"]
    place = result["locations"][0]["physicalLocation"]
    assert (place["artifactLocation"]["uri"], place["region"]["startLine"]) == ("src/a.urdf", 4)
    done = bash(steps["lint"]["run"], repository, **inputs)
    assert done.returncode == 1
    assert re.search(r"^::error file=src/a\.urdf,line=4,", done.stdout, re.MULTILINE)
    (repository / "src/a.urdf").write_text(DEFECT.replace("bse", "base"))
    assert bash(steps["lint"]["run"], repository, **inputs).returncode == 0


@pytest.mark.slow
def test_the_job_of_gitlab_writes_its_report_and_fails(repository: Path) -> None:
    job = yaml.safe_load(GUIDE[".gitlab-ci.yml"])["lint"]
    assert job["script"][0] == "pip install urdfkit"
    done = bash("\n".join(job["script"][1:]), repository)
    assert done.returncode == 1
    report = ElementTree.parse(repository / job["artifacts"]["reports"]["junit"]).getroot()
    [failure] = report.iter("failure")
    assert "bse" in str(failure.get("message"))


@pytest.mark.slow
def test_the_image_installs_an_extra_and_runs_commands_that_exist(repository: Path) -> None:
    lines = GUIDE["Dockerfile"].splitlines()
    assert [line.split()[0] for line in lines] == ["FROM", "RUN", "COPY", "RUN", "WORKDIR", "ENTRYPOINT"]
    extra = re.search(r"'/opt/urdfkit\[(\w+)\]'", GUIDE["Dockerfile"])
    assert extra
    assert f"\n{extra[1]} = [" in (ROOT / "pyproject.toml").read_text()
    [command] = re.findall(r"urdfkit sim \w+", GUIDE["Dockerfile"])
    assert bash(f"{command} --help", repository).returncode == 0
    assert json.loads(lines[-1].removeprefix("ENTRYPOINT ")) == ["urdfkit"]
    assert {".git", ".venv", "build"} <= set((ROOT / ".dockerignore").read_text().split())  # not copied by `COPY .`
