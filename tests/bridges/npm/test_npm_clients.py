"""roslib and @foxglove/ws-protocol of npm, as users of these servers have them, against a simulation."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

from tests.time_limit import PATIENCE

PACKAGES = ("roslib@2.1.0", "@foxglove/ws-protocol@0.8.0", "ws@8")
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def npm_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the packages; the tests are skipped without npm or its registry."""
    npm = shutil.which("npm")
    if npm is None or shutil.which("node") is None:
        pytest.skip("needs node and npm")
    folder = tmp_path_factory.mktemp("npm")
    (folder / "package.json").write_text("{}")
    install = [npm, "install", "--no-audit", "--no-fund", "--ignore-scripts", "--fetch-retries=0", *PACKAGES]
    done = subprocess.run(install, cwd=folder, capture_output=True, text=True, timeout=PATIENCE, check=False)
    if done.returncode != 0:
        pytest.skip(f"npm cannot install the packages: {(done.stderr or 'no reason').splitlines()[-1]}")
    return folder


@contextmanager
def simulated(option: str) -> Iterator[str]:
    """Simulate with a server; yield its address."""
    command = [sys.executable, "-m", "urdfkit", "sim", "run", "simpleton", "--for", "1000", option, "0"]
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as simulation:
        try:
            assert simulation.stderr is not None
            yield next(found[0] for line in simulation.stderr if (found := re.search(r"ws://\S+", line)))
        finally:
            simulation.terminate()
            simulation.wait()


def run(folder: Path, script: str, *words: str) -> dict[str, Any]:
    copy = shutil.copy(Path(__file__).with_name(script), folder)
    done = subprocess.run(["node", copy, *words], capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    found: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return found


def test_roslib_of_npm(npm_folder: Path) -> None:
    with simulated("--rosbridge") as url:
        seen = run(npm_folder, "roslib_client.mjs", url)
    assert seen["topics"]["/simpleton/odom"] == "nav_msgs/msg/Odometry"
    assert seen["image"] == ["rgb8", 800, 800, 800 * 800 * 3]
    assert seen["png"] == "base_footprint"
    assert seen["x"] > 1.0
    assert "simpleton" in seen["entities"]


def test_ws_protocol_of_npm(npm_folder: Path) -> None:
    with simulated("--foxglove") as url:
        seen = run(npm_folder, "foxglove_client.cjs", url, "package://simpleton_description/meshes/none.stl")
    assert seen["topics"]["/simpleton/odom"] == ["cdr", "nav_msgs/msg/Odometry", "ros2msg"]
    assert {"clientPublish", "services", "assets", "time", "parameters"} <= set(seen["capabilities"])
    assert seen["x"] > 1.0
    assert seen["time"] > 0
    assert seen["service"]["state"] == {"state": 1}
    assert "none.stl" in seen["asset"]
