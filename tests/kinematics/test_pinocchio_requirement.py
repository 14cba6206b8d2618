from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.errors import MissingDependencyError
from urdfkit.kinematics.pinocchio_requirement import require_pinocchio


@pytest.fixture
def without_pinocchio(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pinocchio", None)


@pytest.mark.usefixtures("without_pinocchio")
@pytest.mark.parametrize(
    ("platform", "machine", "message"),
    [
        ("linux", "x86_64", r"^tf needs pinocchio: pip install 'urdfkit\[view\]'$"),
        ("darwin", "arm64", r"^tf needs pinocchio: pip install 'urdfkit\[view\]'$"),
        ("win32", "AMD64", r"^tf needs pinocchio: it has no wheels for Windows; inside WSL .* pip install"),
        ("darwin", "x86_64", r"^tf needs pinocchio: it has no wheels for macOS on Intel; .* WSL.* pip install"),
    ],
)
def test_a_missing_pinocchio_says_what_to_run(
    monkeypatch: pytest.MonkeyPatch, platform: str, machine: str, message: str
) -> None:
    monkeypatch.setattr(sys, "platform", platform)
    monkeypatch.setattr("platform.machine", lambda: machine)
    with pytest.raises(MissingDependencyError, match=message):
        require_pinocchio("tf")


def test_another_package_called_pinocchio_is_recognised(monkeypatch: pytest.MonkeyPatch) -> None:
    """PyPI has a package `pinocchio` that is an extension of nose."""
    monkeypatch.setitem(sys.modules, "pinocchio", type(sys)("pinocchio"))
    with pytest.raises(
        MissingDependencyError, match=r"not the robotics library: pip uninstall pinocchio && pip install"
    ):
        require_pinocchio("tf")


OPENMP = "the library libgomp.so.1: apt-get install libgomp1 on Debian and Ubuntu, dnf install libgomp on Fedora"


@pytest.mark.parametrize(
    ("words", "error", "needed"),
    [
        (["tf", "simpleton"], "no such module", "pinocchio: pip install 'urdfkit[view]'"),
        (["tf", "simpleton", "--tree"], "no such module", "pinocchio: pip install 'urdfkit[view]'"),
        (["tf", "simpleton"], "libgomp.so.1: cannot open shared object file: No such file or directory", OPENMP),
    ],
)
def test_the_command_prints_one_line(words: list[str], error: str, needed: str, tmp_path: Path) -> None:
    (tmp_path / "pinocchio.py").write_text(f"raise ImportError({error!r})\n", encoding="utf-8")
    command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(tmp_path)!r})\n"]
    command[-1] += f"from urdfkit.cli import main; sys.exit(main({words!r}))"
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == f"urdfkit: tf needs {needed}\n"
