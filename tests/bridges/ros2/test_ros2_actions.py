"""Actions over ROS 2 with clients and servers of real rclpy and a control_msgs that is compiled here."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds")

from tests.bridges.ros2.test_real_nodes import LOCAL, node_python, simulated, urdfkit_by
from tests.bridges.rosbridge.test_actions import FOLLOW, ros2_arm_file
from tests.time_limit import PATIENCE

HERE = Path(__file__).parent
NAME = "/arm_controller/follow_joint_trajectory"
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")} | LOCAL

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def control_msgs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with control_msgs for rclpy of Kilted."""
    python = node_python("kilted")
    if shutil.which("g++") is None or not (python.parents[1] / "share" / "trajectory_msgs").exists():
        pytest.skip("needs g++ and trajectory_msgs: make ros2-nodes")
    folder = tmp_path_factory.mktemp("messages")
    words: list[str | Path] = [python, HERE / "message_package.py", HERE / "control_msgs", folder]
    done = subprocess.run(words, capture_output=True, text=True, env=ENVIRONMENT, check=False)
    assert done.returncode == 0, done.stderr
    return folder


def urdfkit(messages: Path) -> list[str | Path]:
    """Return the command that runs urdfkit with rclpy and control_msgs."""
    return urdfkit_by(
        "kilted", f"sys.path.insert(0, {str(messages)!r}); from urdfkit.cli import main; sys.exit(main())"
    )


def test_an_action_client_of_rclpy_moves_an_arm(control_msgs: Path, tmp_path: Path) -> None:
    words: list[str | Path] = [node_python("kilted"), HERE / "real_action_client.py", NAME, "elbow"]
    with simulated(str(ros2_arm_file(tmp_path)), 64, urdfkit(control_msgs), library="rclpy") as simulation:
        environment = ENVIRONMENT | {"ROS_DOMAIN_ID": "64", "PYTHONPATH": str(control_msgs)}
        done = subprocess.run(words, capture_output=True, text=True, env=environment, timeout=PATIENCE, check=False)
        assert done.returncode == 0, done.stderr
        assert simulation.poll() is None
    seen = json.loads(done.stdout)
    assert [NAME, [FOLLOW]] in seen["actions"]
    assert seen["publishers"] == 1  # the action server, not the topic of the simulation too
    assert seen["joints"] == ["shoulder", "elbow"]
    assert seen["positions"] == 2
    assert seen["states"] == [2, 2, 2]  # executing
    assert seen["reached"] == [4, 0]
    assert seen["rejected"]
    assert (seen["cancelling"], seen["cancelled"][0]) == (1, 5)
    assert (seen["last"][0], seen["replaced"][0]) == (4, 6)
