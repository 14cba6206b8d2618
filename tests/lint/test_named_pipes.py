"""A named pipe in the place of a file of a package is not read: nobody may ever write into it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.time_limit import PATIENCE

pytestmark = pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no named pipes here")

ROBOT = """<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <xacro:include filename="part.xacro"/>
  <link name="a"/>
</robot>
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["package.xml", "config/a.yaml", "config/a.srdf", "launch/a.launch.py", "CMakeLists.txt", "urdf/part.xacro"]
)
def test_lint_does_not_wait_for_a_named_pipe(tmp_path: Path, name: str) -> None:
    for folder in ("config", "launch", "urdf"):
        (tmp_path / folder).mkdir()
    (tmp_path / "package.xml").write_text('<package format="3"><name>r</name></package>')
    (tmp_path / "urdf" / "part.xacro").write_text("<robot/>")
    (tmp_path / "urdf" / "r.urdf.xacro").write_text(ROBOT)
    (tmp_path / name).unlink(missing_ok=True)
    os.mkfifo(tmp_path / name)
    command = [sys.executable, "-m", "urdfkit", "lint", str(tmp_path), "--no-cache"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE)
    assert done.returncode in (0, 1)
    assert ("is not a regular file" in done.stdout) == name.endswith(".xacro")
