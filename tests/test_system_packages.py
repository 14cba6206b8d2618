"""The list of system packages is complete, and the check names what is missing."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests import conftest, system_packages
from tests.system_packages import GROUPS, INSTALL, PACKAGES, SETUP, TESTS, message, missing, read_table, used_by

ROOT = TESTS.parent
DOT = "dottool graphviz command:no-such-program\n"
ALL = """
present      setup,git  command:sh
no-file      git        file:/usr/bin/no-such-*
no-module    git        python:no_such_module
no-config    colcon     cmake:no_such_package
no-pc        sdformat   pkg-config:no-such-module
no-library   opengl     library:libno_such_library.so.1
"""


def test_only_packages_whose_use_is_missing_are_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system_packages, "PACKAGES", read_table(ALL))
    assert [package.name for package in missing(["git"])] == ["no-file", "no-module"]
    found = [package.name for package in missing([SETUP, *GROUPS])]
    assert found == ["no-file", "no-module", "no-config", "no-pc", "no-library"]


@pytest.mark.parametrize("use", ["command:sh", "file:/bin/s*", "library:libc.so.6"])
def test_what_is_installed_is_not_reported(monkeypatch: pytest.MonkeyPatch, use: str) -> None:
    if use.startswith("library") and sys.platform != "linux":
        pytest.skip("the C library has this name on Linux")
    monkeypatch.setattr(system_packages, "PACKAGES", read_table(f"package git {use}\n"))
    assert missing(["git"]) == []


def test_the_message_names_package_use_tests_and_command() -> None:
    line = message(read_table(DOT), with_users=True)
    assert line == (
        "missing system packages: dottool (command no-such-program), used by tests/cli/test_tf.py, "
        f"tests/kinematics/test_frame_tree_drawing.py; install: {INSTALL} dottool"
    )


def test_a_test_without_its_packages_is_skipped_with_that_line(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(system_packages, "PACKAGES", read_table(DOT))
    reason = conftest.reason_to_skip({"graphviz", "parametrize"})
    assert reason == f"missing system packages: dottool (command no-such-program); install: {INSTALL} dottool"
    assert conftest.reason_to_skip({"slow"}) == ""


@pytest.mark.slow
@pytest.mark.parametrize(("ci", "outcome"), [("", "1 skipped"), ("true", "1 error")])
def test_in_ci_a_test_without_its_packages_is_an_error(ci: str, outcome: str, tmp_path: Path) -> None:
    (tmp_path / "test_a.py").write_text("import pytest\n@pytest.mark.graphviz\ndef test_a(): pass\n")
    plugin = tmp_path / "plugin.py"
    plugin.write_text(
        "from tests import system_packages\n"
        f"system_packages.PACKAGES = system_packages.read_table({DOT!r})\n"
        "from tests.conftest import pytest_configure, pytest_runtest_setup\n"
    )
    command = [sys.executable, "-m", "pytest", "-p", "plugin", "-ra", "--rootdir", str(tmp_path), str(tmp_path)]
    environment = {"CI": ci, "PYTHONPATH": f"{tmp_path}:{ROOT}", "PATH": "/usr/bin:/bin"}
    done = subprocess.run(command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False)
    assert outcome in done.stdout
    assert "missing system packages: dottool (command no-such-program); install: " in done.stdout


@pytest.mark.slow
def test_each_package_is_used_and_each_group_is_a_marker() -> None:
    assert len({package.name for package in PACKAGES}) == len(PACKAGES)
    for package in PACKAGES:
        assert used_by(package.groups), package.name
    for group in GROUPS:
        assert used_by([group]), group


@pytest.mark.parametrize("file", [".ci/run", "README.md", "CONTRIBUTING.md", "tests/system_packages.txt"])
def test_the_command_that_installs_reads_the_list(file: str) -> None:
    command = "$(sed 's/[ #].*//' tests/system_packages.txt)"
    assert command in (ROOT / file).read_text(encoding="utf-8")
    printed = subprocess.run(
        ["sh", "-c", f"echo {command}"], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    assert printed.split() == [package.name for package in PACKAGES]
