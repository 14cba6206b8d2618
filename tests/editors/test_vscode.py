"""The extension for VS Code: its own tests, in a stand-in for the editor, with the real ``urdfkit view``."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[2] / "editors" / "vscode"


def extension_tests(*command: str) -> str:
    """Return the output of the tests of the extension, which run a command in place of ``urdfkit``."""
    environment = {**os.environ, "URDFKIT_COMMAND": "\n".join(command)}
    done = subprocess.run(
        ["node", "--test", "test"], cwd=FOLDER, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.node
@pytest.mark.slow
def test_the_extension() -> None:
    pytest.importorskip("meshcat")
    assert "# pass 5" in extension_tests(sys.executable, "-m", "urdfkit")


@pytest.mark.node
def test_the_extension_without_urdfkit_skips_the_preview() -> None:
    shown = extension_tests("no-such-program")
    assert "# pass 4" in shown
    assert "# SKIP cannot run `no-such-program --version`; install urdfkit, or set URDFKIT_COMMAND" in shown


def test_the_files_of_the_manifest_exist() -> None:
    manifest = json.loads((FOLDER / "package.json").read_text())
    given = manifest["contributes"]
    files = [each["configuration"] for each in given["languages"]] + [each["path"] for each in given["grammars"]]
    assert all((FOLDER / file).is_file() for file in files)
    assert (FOLDER / "LICENSE").read_text() == (FOLDER.parents[1] / "LICENSE").read_text()
    extensions = {suffix for each in given["languages"] for suffix in each["extensions"]}
    assert extensions == {".urdf", ".xacro"}
