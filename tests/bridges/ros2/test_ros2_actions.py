"""Actions over ROS 2 with clients and servers of real rclpy and a control_msgs that is compiled here."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest

pytest.importorskip("cyclonedds")

from tests.bridges.ros2.test_real_nodes import LOCAL, node_python, simulated, urdfkit_by
from tests.bridges.rosbridge.test_actions import FOLLOW, ros2_arm_file
from tests.processes import running
from tests.time_limit import PATIENCE

HERE = Path(__file__).parent
NAME, GRIPPER = "/arm_controller/follow_joint_trajectory", "/gripper_controller/gripper_cmd"
CONTROLLERS = """controller_manager:
  ros__parameters:
    update_rate: 100
    arm_controller: {type: joint_trajectory_controller/JointTrajectoryController}
    gripper_controller: {type: position_controllers/GripperActionController}

arm_controller:
  ros__parameters: {joints: [elbow], command_interfaces: [position], state_interfaces: [position, velocity]}

gripper_controller:
  ros__parameters: {joint: shoulder}
"""
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")} | LOCAL

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def distribution() -> str:
    """Return the distribution of ROS 2 whose rclpy is used."""
    return "kilted"


@pytest.fixture(scope="module")
def control_msgs(distribution: str, tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Yield a folder with control_msgs for rclpy; programs that are started find its libraries."""
    python = node_python(distribution)
    if shutil.which("g++") is None or not (python.parents[1] / "share" / "trajectory_msgs").exists():
        pytest.skip("needs g++ and trajectory_msgs: make ros2-nodes")
    folder = tmp_path_factory.mktemp("messages")
    words: list[str | Path] = [python, HERE / "message_package.py", HERE / "control_msgs", folder]
    done = subprocess.run(words, capture_output=True, text=True, env=ENVIRONMENT, check=False)
    assert done.returncode == 0, done.stderr
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("LD_LIBRARY_PATH", str(folder))
        yield folder


def environment_of(messages: Path, domain: int) -> dict[str, str]:
    """Return the variables of a program on a domain."""
    return ENVIRONMENT | {"ROS_DOMAIN_ID": str(domain), "LD_LIBRARY_PATH": str(messages)}


def urdfkit(messages: Path, distribution: str) -> list[str | Path]:
    """Return the command that runs urdfkit with rclpy and control_msgs."""
    return urdfkit_by(
        distribution, f"sys.path.insert(0, {str(messages)!r}); from urdfkit.cli import main; sys.exit(main())"
    )


@pytest.mark.parametrize("distribution", ["kilted", "jazzy"], scope="module")
def test_an_action_client_of_rclpy_moves_an_arm(distribution: str, control_msgs: Path, tmp_path: Path) -> None:
    words: list[str | Path] = [node_python(distribution), HERE / "real_action_client.py", NAME, "elbow", GRIPPER]
    robot = str(ros2_arm_file(tmp_path))
    (tmp_path / "arm_bringup" / "config" / "arm.yaml").write_text(CONTROLLERS)
    with simulated(robot, 64, urdfkit(control_msgs, distribution), library="rclpy") as simulation:
        environment = environment_of(control_msgs, 64) | {"PYTHONPATH": str(control_msgs)}
        done = subprocess.run(words, capture_output=True, text=True, env=environment, timeout=PATIENCE, check=False)
        assert done.returncode == 0, done.stderr
        assert simulation.poll() is None
        simulation.terminate()
        assert simulation.stderr is not None
        lines = [line for line in simulation.stderr.read().splitlines() if "fields of a goal" in line]
    (line,) = lines  # one, of several goals
    assert line.endswith("are ignored, because urdfkit lacks them: multi_dof_trajectory")
    assert NAME in line
    seen = json.loads(done.stdout)
    assert [NAME, [FOLLOW]] in seen["actions"]
    assert seen["publishers"] == 1  # the action server, not the topic of the simulation too
    assert seen["joints"] == ["elbow"]
    assert seen["positions"] == 1
    assert seen["gripped"] == [4, True, pytest.approx(0.3, abs=0.01)]  # the default tolerance
    assert seen["states"] == [2, 2, 2]  # executing
    assert seen["reached"] == [4, 0]
    assert seen["rejected"]
    assert (seen["cancelling"], seen["cancelled"][0]) == (1, 5)
    assert (seen["last"][0], seen["replaced"][0]) == (4, 6)


def test_the_command_sends_goals_to_a_real_server(distribution: str, control_msgs: Path) -> None:
    command = [*urdfkit(control_msgs, distribution), "action"]
    environment = environment_of(control_msgs, 65)
    name = "/arm/follow_joint_trajectory"

    def action(*words: str) -> subprocess.CompletedProcess[str]:
        line = [*command, *words, "--live", "ros2"]
        return subprocess.run(line, capture_output=True, text=True, env=environment, timeout=PATIENCE, check=False)

    def said(done: subprocess.CompletedProcess[str]) -> list[str]:
        """Return the lines of urdfkit; rcutils notes that these types are for one middleware only."""
        return [line for line in done.stderr.splitlines() if line.startswith("urdfkit")]

    def goal(position: float, seconds: int, joint: str = "elbow") -> list[str]:
        points = f"[{{positions: [{position}], time_from_start: {seconds}}}]"
        return ["send", name, f"{{trajectory: {{joint_names: [{joint}], points: {points}}}}}"]

    server = [str(node_python(distribution)), str(HERE / "real_action_server.py")]
    environment_of_server = environment | {"PYTHONPATH": str(control_msgs)}
    with running(server, env=environment_of_server, stdout=subprocess.PIPE, text=True) as arm:
        assert arm.stdout is not None
        assert arm.stdout.readline() == "ready\n"
        done = action(*goal(0.5, 1), "--feedback", "--json")
        *feedback, result = map(json.loads, done.stdout.splitlines())
        assert (done.returncode, said(done), result) == (0, [], {"error_code": 0, "error_string": ""})
        assert feedback[0]["joint_names"] == ["elbow"]
        assert feedback[0]["desired"]["positions"] == [0.5]
        assert action("list", "--types").stdout == f"{name} [{FOLLOW}]\n"
        done = action(*goal(0.5, 1, "wrist"))
        assert (done.returncode, done.stdout, said(done)) == (1, "", ["urdfkit: the goal is rejected"])
        done = action(*goal(1.5, 0), "--json")
        assert (done.returncode, said(done)) == (1, ["urdfkit: the goal is aborted"])
        assert json.loads(done.stdout) == {"error_code": -4, "error_string": "elbow is off by 0.5 rad"}
        done = action("send", "/arm/follow_joint_trajektory")
        assert (done.returncode, done.stdout) == (2, "")
        assert said(done) == [f"urdfkit: unknown action `/arm/follow_joint_trajektory`; did you mean `{name}`?"]
        words = [*map(str, command), *goal(0.5, 60), "--feedback", "--json", "--live", "ros2"]
        with running(words, env=environment, stdout=subprocess.PIPE, text=True) as sending:
            assert sending.stdout is not None
            assert "elbow" in sending.stdout.readline()
            sending.send_signal(signal.SIGINT)
            assert arm.stdout.readline() == "canceled\n"
        pipe = subprocess.PIPE
        with running(words, env=environment, stdout=pipe, stderr=pipe, text=True) as sending:
            assert sending.stdout is not None
            assert "elbow" in sending.stdout.readline()
            arm.kill()
            _, errors = sending.communicate(timeout=PATIENCE)
            said_then = [line for line in errors.splitlines() if line.startswith("urdfkit")]
            assert said_then == [f"urdfkit: the goal is aborted: the server of {name} has left the graph"]
            assert sending.returncode == 1
