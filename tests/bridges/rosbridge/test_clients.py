"""roslibpy as a user runs it: its own process, against a simulation in another one."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pytest

from tests.time_limit import PATIENCE

pytest.importorskip("roslibpy")


@pytest.mark.slow
def test_roslibpy_sees_topics_and_drives_one_metre() -> None:
    command = ["urdfkit", "sim", "run", "simpleton", "--for", "1000", "--rosbridge", "0"]
    with subprocess.Popen([sys.executable, "-m", *command], stderr=subprocess.PIPE, text=True) as simulation:
        try:
            assert simulation.stderr is not None
            port = next(found[1] for line in simulation.stderr if (found := re.search(r"rosbridge: .*:(\d+)$", line)))
            done = subprocess.run(
                [sys.executable, Path(__file__).with_name("client.py"), port],
                capture_output=True,
                text=True,
                timeout=PATIENCE,
                check=True,
            )
        finally:
            simulation.terminate()
            simulation.wait()
    seen = json.loads(done.stdout)
    assert seen["x"] > 1.0
    assert seen["types"]["/simpleton/odom"] == "nav_msgs/msg/Odometry"
    assert seen["types"]["/clock"] == "rosgraph_msgs/msg/Clock"
    assert seen["image"] == ["rgb8", 800, 800]
    assert seen["reset"] == {}
    assert seen["delete"]["success"] is False
    assert "no model or robot `nobody`" in seen["delete"]["status_message"]
    assert '<robot name="simpleton">' in seen["description"]
