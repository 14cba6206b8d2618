"""Goals that roslibpy sends to trajectory controllers of ROS 1 and of ROS 2."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from tests.served_simulation import rosbridge
from tests.sim import arm_package
from tests.sim.plugins.controllers.test_ros2_control import BLOCK, GZ, TRAJECTORIES, command
from tests.time_limit import PATIENCE
from urdfkit.app.simulation.bridging.real_time import RunControls
from urdfkit.app.simulation.bridging.services import simulation_services
from urdfkit.bridges.actions import ActionServer, SentGoal, actions, find_action
from urdfkit.bridges.json_messages import from_json, json_values
from urdfkit.errors import UsageError
from urdfkit.sim import Simulator

pytest.importorskip("roslibpy")

REJECTED, SUCCEEDED, CANCELED = 0, 4, 5
FOLLOW = "control_msgs/action/FollowJointTrajectory"


def ros2_arm(folder: Path) -> Simulator:
    """Return an arm whose controller belongs to ROS 2."""
    return Simulator(ros2_arm_file(folder), note=lambda _: None)


def ros2_arm_file(folder: Path) -> Path:
    """Write the file of an arm whose controller belongs to ROS 2."""
    config = arm_package.package(folder, "arm_bringup") / "config"
    config.mkdir(exist_ok=True)
    (config / "arm.yaml").write_text(f"{TRAJECTORIES}    allow_partial_joints_goal: true\n")
    filename, name, hardware = GZ
    path = "$(find arm_bringup)/config/arm.yaml"
    block = BLOCK.format(
        filename=filename, name=name, hardware=hardware, commands=command("position"), more="", initial="", path=path
    )
    return arm_package.write_arm(folder, block)


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


def test_the_controller_manager_of_ros2_control_has_its_services(tmp_path: Path) -> None:
    simulator = ros2_arm(tmp_path)
    services = simulation_services(simulator, RunControls(simulator))

    def call(service_name: str, **fields: object) -> Any:
        service = services[f"/controller_manager/{service_name}"]
        assert service.type.startswith("controller_manager_msgs/srv/")
        return json_values(service.call(from_json(service.request, fields)))

    def states() -> dict[str, str]:
        return {row["name"]: row["state"] for row in call("list_controllers")["controller"]}

    (trajectories,) = [row for row in call("list_controllers")["controller"] if row["name"] == "arm_controller"]
    assert trajectories["type"] == "joint_trajectory_controller/JointTrajectoryController"
    assert trajectories["claimed_interfaces"] == ["shoulder/position", "elbow/position"]
    assert call("switch_controller", deactivate_controllers=["arm_controller"], strictness=2) == {"ok": True}
    assert states() == {"joint_state_broadcaster": "active", "arm_controller": "inactive"}
    assert call("unload_controller", name="arm_controller") == {"ok": True}
    assert states() == {"joint_state_broadcaster": "active"}
    assert call("switch_controller", activate_controllers=["arm_contoller"], strictness=2) == {"ok": False}
    assert call("load_controller", name="arm_controller") == {"ok": True}
    assert call("configure_controller", name="nobody") == {"ok": False}
    assert call("switch_controller", activate_controllers=["arm_controller"], strictness=2) == {"ok": True}
    assert set(states().values()) == {"active"}
    assert not [name for name in simulation_services(*of("heterogeneous")) if "controller_manager" in name]


def of(robot: str) -> tuple[Simulator, RunControls]:
    simulator = Simulator(robot, note=lambda _: None)
    return simulator, RunControls(simulator)
