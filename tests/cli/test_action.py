"""`urdfkit action` on an arm that is simulated in a thread of this process, also over rosbridge."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
import yaml

pytest.importorskip("meshcat")
pytest.importorskip("numba")

from tests.bridges.rosbridge.test_actions import ros2_arm
from tests.processes import running
from tests.served_simulation import driven, rosbridge
from tests.time_limit import PATIENCE
from urdfkit.app.simulation.loop import DriveLoop
from urdfkit.cli import main
from urdfkit.sim import Simulator

pytestmark = pytest.mark.slow
NAME = "/heterogeneous/arm_controller/follow_joint_trajectory"


@pytest.fixture(scope="module")
def arm(tmp_path_factory: pytest.TempPathFactory) -> Iterator[DriveLoop]:
    with driven(Simulator("heterogeneous", note=lambda _: None), tmp_path_factory.mktemp("runtime")) as loop:
        yield loop


def goal(position: float, seconds: float, joint: str = "jarmLink0") -> str:
    point = f"{{positions: [{position}], time_from_start: {seconds}}}"
    return f"{{trajectory: {{joint_names: [{joint}], points: [{point}]}}}}"


def test_a_goal_is_reached_or_refused(arm: DriveLoop, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["action", "list", "--types"]) == 0
    assert capsys.readouterr().out == f"{NAME} [control_msgs/action/FollowJointTrajectory]\n"
    assert main(["action", "send", NAME, goal(0.2, 0.5), "--feedback", "--json"]) == 0
    *feedback, result = map(json.loads, capsys.readouterr().out.splitlines())
    assert result == {"error_code": 0, "error_string": ""}
    assert "jarmLink0" in feedback[0]["joint_names"]
    assert arm.simulator.state.position("jarmLink0") == pytest.approx(0.2, abs=0.01)
    assert main(["action", "send", NAME, goal(0.2, 0.5, "jarmLink9")]) == 1
    printed = capsys.readouterr()
    assert yaml.safe_load(printed.out)["error_code"] == -2
    assert printed.err.startswith("urdfkit: the goal is rejected: unknown joint `jarmLink9`; did you mean `jarmLink")
    assert printed.err.count("\n") == 1
    for words, expected in (
        (["send", "/arm_controler/follow_joint_trajectory"], f"did you mean `{NAME}`?"),
        (["send", NAME, "{trajectories: 1}"], "did you mean `trajectory`?"),
        (["sent"], "did you mean `send`?"),
    ):
        assert main(["action", *words]) == 2
        line = capsys.readouterr().err
        assert expected in line
        assert line.count("\n") == 1


def test_ctrl_c_cancels_the_goal(arm: DriveLoop) -> None:
    states: list[int] = []
    arm.simulator.bus.subscribe(
        f"{NAME}/result",
        "control_msgs/msg/FollowJointTrajectoryActionResult",
        lambda it: states.append(it.status.status),
    )
    command = [sys.executable, "-m", "urdfkit", "action", "send", NAME, goal(1.0, 60.0), "--feedback", "--json"]
    with running(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as sending:
        assert sending.stdout is not None
        assert "joint_names" in sending.stdout.readline()
        sending.send_signal(signal.SIGINT)
        assert sending.communicate(timeout=PATIENCE)[1] == ""
    assert states == [2]  # preempted


@pytest.mark.parametrize("ros", [1, 2])
def test_goals_are_sent_to_a_live_robot(ros: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    simulator = Simulator("heterogeneous", note=lambda _: None) if ros == 1 else ros2_arm(tmp_path)
    name, joint = (NAME, "jarmLink0") if ros == 1 else ("/arm_controller/follow_joint_trajectory", "elbow")
    with rosbridge(simulator) as url:
        assert main(["action", "list", "--types", "--live", url]) == 0
        assert capsys.readouterr().out == f"{name} [control_msgs/action/FollowJointTrajectory]\n"
        assert main(["action", "send", name, goal(0.2, 0.5, joint), "--feedback", "--json", "--live", url]) == 0
        *feedback, result = map(json.loads, capsys.readouterr().out.splitlines())
        assert result == {"error_code": 0, "error_string": ""}
        assert joint in feedback[0]["joint_names"]
        assert main(["action", "send", name, goal(0.2, 0.5, "jarmLink9"), "--live", url]) == 1
        assert capsys.readouterr().err.startswith("urdfkit: the goal is rejected")
        assert main(["action", "send", "/arm_controler/follow_joint_trajectory", "--live", url]) == 2
        line = capsys.readouterr().err
        assert f"did you mean `{name}`?" in line
        assert line.count("\n") == 1
