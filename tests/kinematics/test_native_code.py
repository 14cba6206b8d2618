"""Machine code of the kernel: stored, loaded, recompiled when damaged or not storable, and refused without numba."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from tests.kinematics.conftest import ARM
from urdfkit import load
from urdfkit.errors import MissingDependencyError
from urdfkit.kinematics import Chain
from urdfkit.kinematics.serial.kernel import native_code

SCRIPT = """
import sys
from urdfkit.kinematics import Chain
lines = []
chain = Chain(sys.argv[1], "world", "elbow", compiling=lines.append)
print(len(lines), repr(chain.forward([0.3, 0.1, 0.5]).tolist()), len(lines))
"""


@pytest.mark.slow
def test_code_is_stored_and_damaged_files_are_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NUMBA_CACHE_DIR", str(tmp_path / "cache"))
    robot = tmp_path / "arm.urdf"
    robot.write_text(ARM, encoding="utf-8")

    def run() -> tuple[str, str]:
        done = subprocess.run([sys.executable, "-c", SCRIPT, robot], capture_output=True, text=True, check=True)
        compiled = done.stdout.split()[-1]
        return compiled, done.stdout

    compiled, first = run()
    assert compiled == "1"
    (file,) = (tmp_path / "cache" / "urdfkit").glob("*.o")
    content = file.read_bytes()
    assert run()[0] == "0"
    for damaged in (content[:-100], content[:40], b"", content[:-1] + b"x"):
        file.write_bytes(damaged)
        compiled, again = run()
        assert compiled == "1"
        assert again == first
        assert file.read_bytes()[:60] == content[:60]


def test_chains_with_different_callbacks_share_the_code(tmp_path: Path) -> None:
    robot = tmp_path / "arm.urdf"
    robot.write_text(ARM, encoding="utf-8")
    chains = [Chain(load(robot), "world", "elbow", compiling=callback) for callback in (None, print, lambda _: None)]
    poses = [chain.forward(np.zeros(3)) for chain in (*chains, *chains)]
    assert all((pose == poses[0]).all() for pose in poses)


def test_a_missing_numba_is_reported(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(native_code, "_functions", {})
    monkeypatch.setattr(native_code, "find_spec", lambda _: None)
    with pytest.raises(MissingDependencyError, match=r"need numba: pip install 'urdfkit\[sim\]'"):
        native_code.function("solve")
