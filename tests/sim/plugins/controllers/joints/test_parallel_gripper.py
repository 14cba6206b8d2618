"""parallel_gripper_action_controller: goals as joint states, stalling, and what it refuses."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from tests.sim import arm_package
from urdfkit.app.simulation.features.joint_sliders import ControllerSliders
from urdfkit.errors import UrdfkitError
from urdfkit.messages import from_fields
from urdfkit.sim import Simulator

ACTION = "control_msgs/action/ParallelGripperCommand"
SUCCEEDED, ABORTED = 4, 6
BLOCK = """
  <ros2_control name="arm" type="system"><hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="elbow"><command_interface name="position"/><state_interface name="position"/></joint>
  </ros2_control>
  <gazebo><plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    <parameters>$(find arm_bringup)/config/arm.yaml</parameters></plugin></gazebo>
"""
YAML = """controller_manager:
  ros__parameters:
    grip: {type: parallel_gripper_action_controller/GripperActionController}
grip:
  ros__parameters: {MORE}
"""


class Rig:
    """An arm whose elbow is the gripper, and what it states."""

    def __init__(self, folder: Path, more: str, **options: Any) -> None:
        config = arm_package.package(folder, "arm_bringup") / "config"
        config.mkdir(exist_ok=True)
        (config / "arm.yaml").write_text(YAML.replace("MORE", more))
        self.notes: list[str] = []
        arm = options.pop("arm", {})
        urdf = arm_package.write_arm(folder, BLOCK, **arm)
        self.simulator = Simulator(urdf, note=self.notes.append, **options)
        self.results: list[Any] = []
        self.feedback: list[Any] = []
        for ending, kind, kept in (
            ("get_result", "_GetResult_Response", self.results),
            ("feedback", "_FeedbackMessage", self.feedback),
        ):
            self.simulator.subscribe(f"/grip/gripper_cmd/_action/{ending}", f"{ACTION}{kind}", kept.append)

    def send(self, *positions: float) -> None:
        kind = f"{ACTION}_SendGoal_Request"
        message = from_fields(kind, {"goal": {"command": {"position": list(positions)}}})
        self.simulator.bus.publish("/grip/gripper_cmd/_action/send_goal", kind, message)

    @property
    def elbow(self) -> float:
        return float(self.simulator.state.position("elbow"))


@pytest.fixture
def rig(tmp_path: Path) -> Callable[..., Rig]:
    return lambda more="joint: elbow", **options: Rig(tmp_path, more, **options)


def test_it_goes_there_and_says_so(rig: Callable[..., Rig]) -> None:
    made = rig("joint: elbow, goal_tolerance: 0.001", gravity=(0, 0, 0))
    made.send(0.6)
    made.simulator.run(3.0)
    assert made.elbow == pytest.approx(0.6, abs=1e-3)
    (last,) = made.results
    assert (last.status, last.result.reached_goal, last.result.stalled) == (SUCCEEDED, True, False)
    assert last.result.state.name == ["elbow"]
    assert last.result.state.position == pytest.approx([0.6], abs=1.1e-3)
    assert made.feedback[0].feedback.state.position[0] < 0.6
    assert made.notes == []


@pytest.mark.parametrize(("more", "end"), [("", ABORTED), (", allow_stalling: true", SUCCEEDED)])
def test_what_holds_it_up_stalls_it(rig: Callable[..., Rig], more: str, end: int) -> None:
    made = rig(f"joint: elbow, stall_timeout: 0.3{more}", gravity=(0, 0, 0))
    made.send(9.0)  # its limits hold it up
    made.simulator.run(6.0)
    (last,) = made.results
    assert (last.status, last.result.reached_goal, last.result.stalled) == (end, False, True)
    assert last.result.state.position == pytest.approx([made.elbow], abs=1e-4)  # it creeps on


def test_it_takes_one_position(rig: Callable[..., Rig]) -> None:
    made = rig(gravity=(0, 0, 0))
    made.send(0.1, 0.2)
    made.simulator.run(0.5)
    assert made.results == []
    assert any("accepts one position, not 2" in note for note in made.notes)
    assert made.elbow == pytest.approx(0.0, abs=1e-6)


def test_interfaces_that_the_simulator_has_not_are_told_of(rig: Callable[..., Rig]) -> None:
    made = rig("joint: elbow, max_effort_interface: elbow/set_gripper_max_effort")
    assert any("`max_effort_interface` is ignored" in note for note in made.notes)


def test_a_joint_is_needed(rig: Callable[..., Rig]) -> None:
    with pytest.raises(UrdfkitError, match="joint"):
        rig("goal_tolerance: 0.1", strict=True)


def test_a_slider_tells_it(rig: Callable[..., Rig]) -> None:
    made = rig(gravity=(0, 0, 0))
    (robot,) = made.simulator.world.robots.values()
    (controller,) = (each for each in robot.plugins.controllers if each.loop is not None)
    arm = ControllerSliders(robot, controller.loop.controllers["grip"])
    assert arm.of == "position"
    arm.command(made.simulator.bus, "elbow", 0.3)
    made.simulator.run(2.0)
    assert made.elbow == pytest.approx(0.3, abs=1e-2)
