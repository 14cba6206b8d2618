"""Goals that roslibpy sends to trajectory controllers of ROS 1 and of ROS 2."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from urllib.parse import urlsplit

import pytest

from tests.served_simulation import rosbridge
from tests.sim import arm_package
from tests.sim.plugins.controllers.test_ros2_control import BLOCK, GZ, TRAJECTORIES, command
from tests.time_limit import PATIENCE
from urdfkit.bridges.actions import ActionServer, SentGoal, actions, find_action
from urdfkit.errors import UsageError
from urdfkit.sim import Simulator

pytest.importorskip("roslibpy")

REJECTED, SUCCEEDED, CANCELED = 0, 4, 5
FOLLOW = "control_msgs/action/FollowJointTrajectory"


def ros2_arm(folder: Path) -> Simulator:
    """Return an arm whose controller belongs to ROS 2."""
    config = arm_package.package(folder, "arm_bringup") / "config"
    config.mkdir(exist_ok=True)
    (config / "arm.yaml").write_text(f"{TRAJECTORIES}    allow_partial_joints_goal: true\n")
    filename, name, hardware = GZ
    path = "$(find arm_bringup)/config/arm.yaml"
    block = BLOCK.format(
        filename=filename, name=name, hardware=hardware, commands=command("position"), more="", initial="", path=path
    )
    return Simulator(arm_package.write_arm(folder, block), note=lambda _: None)


@pytest.mark.slow
@pytest.mark.parametrize("ros", [1, 2])
def test_roslibpy_moves_an_arm(ros: int, tmp_path: Path) -> None:
    simulator = Simulator("heterogeneous", note=lambda _: None) if ros == 1 else ros2_arm(tmp_path)
    ((name, action),) = actions(simulator.bus).items()
    assert action == ActionServer(name, FOLLOW, is_rcl=ros == 2)
    joint = "jarmLink0" if ros == 1 else "elbow"
    with rosbridge(simulator) as url:
        words = [sys.executable, str(Path(__file__).with_name("action_client.py")), str(urlsplit(url).port)]
        done = subprocess.run([*words, name, joint], capture_output=True, text=True, timeout=PATIENCE, check=False)
    assert done.returncode == 0, done.stderr
    seen = json.loads(done.stdout)
    assert seen["reached"] == [SUCCEEDED, {"error_code": 0, "error_string": ""}]
    assert joint in seen["joints"]
    state, values = seen["rejected"]
    assert state == REJECTED
    assert values == "the goal is rejected" if ros == 2 else values["error_code"] == -2
    assert seen["cancelled"][0] == CANCELED


def test_unknown_actions_and_fields_are_refused() -> None:
    bus = Simulator("heterogeneous", note=lambda _: None).bus
    with pytest.raises(UsageError, match="did you mean `/heterogeneous/arm_controller/follow_joint_trajectory`"):
        find_action(bus, "arm_controler/follow_joint_trajectory")
    (action,) = actions(bus).values()
    with pytest.raises(UsageError, match="did you mean `trajectory`"):
        SentGoal(bus, action, {"trajektory": {}}, feedback=print, ended=print)
