"""The Python blocks of pages without a test of their own run as written, each in a fresh process and folder."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.test_commands import MODEL
from tests.processes import running

pytest.importorskip("numba")

ROOT = Path(__file__).parents[2]
PAGES = (
    "README",
    "docs/controllers",
    "docs/kinematics",
    "docs/reach",
    "docs/retiming",
    "docs/srdf",
    "docs/worlds",
    "docs/xacro",
)

pytestmark = pytest.mark.slow


def block(page: str, language: str = "python") -> str:
    """Return the first block of a page in a language."""
    return re.findall(
        rf"^```{language}\n(.*?)^```", (ROOT / f"{page}.md").read_text("utf-8"), re.MULTILINE | re.DOTALL
    )[0]


def run(code: str, folder: Path, *arguments: str) -> str:
    """Run code in a fresh process; return its output."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "XDG_RUNTIME_DIR": str(folder)}
    words = [sys.executable, "-c", code, *arguments]
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.parametrize("page", PAGES)
def test_the_script_of_a_page_runs(page: str, tmp_path: Path) -> None:
    (tmp_path / "robot.urdf.xacro").write_text(MODEL)
    printed = run(block(page), tmp_path)
    if "\nIt prints:\n" in (ROOT / f"{page}.md").read_text("utf-8"):
        assert printed == block(page, "text")


def test_the_client_of_the_protocol_prints_the_first_messages(tmp_path: Path) -> None:
    words = [
        sys.executable,
        "-m",
        "urdfkit",
        "sim",
        "teleop",
        "simpleton",
        "--no-browser",
        "--no-terminal",
        "--port",
        "0",
    ]
    with running(words, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        assert process.stdout is not None
        address = process.stdout.readline().strip()
        printed = run(block("docs/protocol"), tmp_path, address).splitlines()
    shown = block("docs/protocol", "text").splitlines()
    assert len(printed) == len(shown) == 3
    for line, expected in zip(printed, shown, strict=True):
        beginning = re.sub(r"'number': \d+", "'number': 0", line)
        assert beginning.startswith(re.sub(r"'number': \d+", "'number': 0", expected).partition(" …")[0])
