"""gz_ros2_control and gazebo_ros2_control: parameter files, trajectories, forwarded commands, holding, errors."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from tests.sim import arm_package
from tests.suggestions import contains
from urdfkit.description import load
from urdfkit.description.hardware_defects import simulation_hint
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.lint import lint
from urdfkit.messages import FLOATS, JOINT_STATE, TRAJECTORY, TRAJECTORY_STATE, from_fields
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.plugins.controllers import ros2_control

GZ = ("gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin", "gz_ros2_control/GazeboSimSystem")
CLASSIC = ("libgazebo_ros2_control.so", "gazebo_ros2_control", "gazebo_ros2_control/GazeboSystem")

BLOCK = """
  <ros2_control name="arm" type="system"><hardware><plugin>{hardware}</plugin></hardware>
    <joint name="shoulder">{commands}<state_interface name="position">{initial}</state_interface></joint>
    <joint name="elbow">{commands}<state_interface name="position"/></joint>
  </ros2_control>
  <gazebo><plugin filename="{filename}" name="{name}">
    <parameters>{path}</parameters>{more}</plugin></gazebo>
"""

BOSS = """controller_manager:
  ros__parameters:
    update_rate: 100
    joint_state_broadcaster: {type: joint_state_broadcaster/JointStateBroadcaster}
"""

TRAJECTORIES = (
    BOSS
    + """    arm_controller:
      type: joint_trajectory_controller/JointTrajectoryController

arm_controller:
  ros__parameters:
    joints: [shoulder, elbow]
    command_interfaces: [position]
    state_interfaces: [position, velocity]
"""
)
Make = Callable[..., Any]


def command(kind: str) -> str:
    return f'<command_interface name="{kind}"/>'


@pytest.fixture
def make(tmp_path: Path) -> Make:
    def build(yaml: str, flavour: tuple[str, str, str] = GZ, commands: str = command("position"), more: str = "",
              initial: str = "", arm: dict[str, Any] | None = None, **options: Any) -> Any:  # fmt: skip
        config = arm_package.package(tmp_path, "arm_bringup") / "config"
        config.mkdir(exist_ok=True)
        (config / "arm.yaml").write_text(yaml)
        filename, name, hardware = flavour
        path = options.pop("path", "$(find arm_bringup)/config/arm.yaml")
        block = BLOCK.format(
            filename=filename, name=name, hardware=hardware, commands=commands, more=more, initial=initial, path=path
        )
        options.setdefault("note", lambda _: None)
        return Simulator(arm_package.write_arm(tmp_path, block, **(arm or {})), **options)

    return build


def positions(simulator: Any) -> tuple[float, float]:
    return simulator.state.position("shoulder"), simulator.state.position("elbow")


def trajectory(*points: tuple[float, list[float]], joints: tuple[str, ...] = ("shoulder", "elbow")) -> Any:
    fields = [{"positions": p, "time_from_start": {"sec": int(t), "nanosec": round(t % 1 * 1e9)}} for t, p in points]
    return from_fields(TRAJECTORY, {"joint_names": list(joints), "points": fields})


@pytest.mark.parametrize("flavour", [GZ, CLASSIC], ids=["gz", "classic"])
@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_a_trajectory_published_at_a_time_is_followed(make: Make, flavour: tuple[str, str, str], dt: float) -> None:
    simulator = make(TRAJECTORIES, flavour, dt=dt)
    message = trajectory((1.0, [0.6, -0.3]), (3.0, [1.0, 0.5]))
    simulator.at(0.5, lambda: simulator.bus.publish("/arm_controller/joint_trajectory", TRAJECTORY, message))
    seen: list[Any] = []
    simulator.subscribe("/arm_controller/controller_state", TRAJECTORY_STATE, seen.append)
    simulator.run(1.0)
    wanted = seen[-1]
    assert wanted.joint_names == ["shoulder", "elbow"]
    assert wanted.reference.positions == pytest.approx([0.3, -0.15])  # half way of a straight line
    assert wanted.error.positions == pytest.approx(wanted.reference.positions - wanted.feedback.positions)
    # gz_ros2_control closes a tenth of the error in each control period: it lags by a speed of ten per second.
    lag = (0.06, -0.03) if flavour is GZ else (0.0, 0.0)
    assert positions(simulator) == pytest.approx((0.3 - lag[0], -0.15 - lag[1]), abs=8e-3)
    simulator.run(4.0)
    assert positions(simulator) == pytest.approx((1.0, 0.5), abs=1e-3)


def test_update_rate_and_gain_decide_how_fast_gz_closes_in(make: Make) -> None:
    yaml = TRAJECTORIES.replace("update_rate: 100", "update_rate: 50")
    simulator = make(yaml, more="<position_proportional_gain>0.02</position_proportional_gain>", gravity=(0, 0, 0))
    message = trajectory((0.0, [0.5, 0.0]), (0.01, [0.5, 0.0]))
    simulator.bus.publish("/arm_controller/joint_trajectory", TRAJECTORY, message)
    simulator.run(2.0)
    assert positions(simulator)[0] == pytest.approx(0.5 * (1 - (1 - 0.02) ** 100), abs=0.01)


def test_joint_states(make: Make) -> None:
    simulator = make(TRAJECTORIES)
    seen: list[Any] = []
    simulator.subscribe("/joint_states", JOINT_STATE, seen.append)
    simulator.run(1.0)
    assert len(seen) == 100
    assert seen[-1].name == ["shoulder", "elbow"]


@pytest.mark.parametrize(
    ("kind", "type"),
    [
        ("position", "position_controllers/JointGroupPositionController"),
        ("position", "forward_command_controller/ForwardCommandController"),
        ("velocity", "velocity_controllers/JointGroupVelocityController"),
    ],
)
def test_forwarded_commands(make: Make, kind: str, type: str) -> None:
    yaml = (
        BOSS + f"    f:\n      type: {type}\nf:\n  ros__parameters:\n    joints: [elbow]\n    interface_name: {kind}\n"
    )
    simulator = make(yaml, commands=command(kind))
    simulator.bus.publish("/f/commands", FLOATS, from_fields(FLOATS, {"data": [0.5]}))
    simulator.run(2.0)
    assert positions(simulator)[0] == pytest.approx(0.0, abs=1e-3)  # held: nobody commands it
    assert positions(simulator)[1] == pytest.approx(0.5 if kind == "position" else 1.0, abs=2e-3)


def test_a_type_among_the_controllers_own_parameters(make: Make) -> None:
    yaml = TRAJECTORIES.replace("      type: joint_trajectory_controller/JointTrajectoryController\n", "").replace(
        "    arm_controller:\n", ""
    )
    simulator = make(yaml + "    type: joint_trajectory_controller/JointTrajectoryController\n")
    assert [status.name for status in simulator.controllers.list()] == ["joint_state_broadcaster", "arm_controller"]


def test_efforts_are_forwarded_and_limited(make: Make) -> None:
    yaml = (
        BOSS + "    f: {type: effort_controllers/JointGroupEffortController}\n"
        "/**:\n  ros__parameters:\n    joints: [shoulder]\nf:\n  ros__parameters:\n    joints: [elbow]\n"
    )
    simulator = make(yaml, commands=command("effort"), gravity=(0, 0, 0), arm={"effort": 0.5})
    simulator.bus.publish("/f/commands", FLOATS, from_fields(FLOATS, {"data": [5.0]}))
    simulator.run(0.02)
    assert simulator.state.tau[1] == pytest.approx(0.5)


def test_trajectories_by_effort(make: Make) -> None:
    pid = "{p: 300.0, i: 300.0, d: 30.0, i_clamp: 20.0}"
    gains = f"    gains: {{shoulder: {pid}, elbow: {pid}}}\n"
    yaml = TRAJECTORIES.replace("command_interfaces: [position]", "command_interfaces: [effort]") + gains
    simulator = make(yaml, commands=command("effort"))
    simulator.bus.publish("/arm_controller/joint_trajectory", TRAJECTORY, trajectory((1.0, [1.0, -0.5])))
    simulator.run(12.0)
    assert positions(simulator) == pytest.approx((1.0, -0.5), abs=1e-3)


def test_joints_that_stray_from_a_trajectory_are_stopped(make: Make) -> None:
    notes: list[str] = []
    gains = "    gains: {shoulder: {p: 300.0, d: 30.0}, elbow: {p: 300.0, d: 30.0}}\n"
    constraints = "    constraints: {shoulder: {trajectory: 0.05}}\n"
    yaml = TRAJECTORIES.replace("command_interfaces: [position]", "command_interfaces: [effort]") + gains + constraints
    simulator = make(yaml, commands=command("effort"), arm={"effort": 3.0}, note=notes.append)
    simulator.bus.publish("/arm_controller/joint_trajectory", TRAJECTORY, trajectory((1.0, [1.2, 0.0])))
    simulator.run(1.0)
    assert any("stopped: joint `shoulder` is off by 0.05" in note for note in notes)
    wanted = simulator.bus.latest("/arm_controller/controller_state").reference
    assert wanted.positions[0] < 0.2


@pytest.mark.parametrize(("distro", "taken"), [("humble", True), ("jazzy", False), (None, False)])
def test_since_jazzy_trajectories_end_at_rest(make: Make, distro: str | None, taken: bool) -> None:
    simulator = make(TRAJECTORIES, ros_distro=distro)
    message = trajectory((1.0, [0.5, 0.0]))
    message.points[0].velocities = np.array([0.1, 0.0])
    simulator.bus.publish("/arm_controller/joint_trajectory", TRAJECTORY, message)
    simulator.run(2.0)
    assert (abs(positions(simulator)[0]) > 0.1) is taken


def test_joints_without_controller_are_held_unless_told_not_to(make: Make) -> None:
    held = make(BOSS, spawn=Spawn(z=0, joints={"shoulder": 0.5}))
    held.run(1.0)
    assert positions(held) == pytest.approx((0.5, 0.0), abs=1e-6)
    free = make(BOSS, more="<hold_joints>false</hold_joints>", spawn=Spawn(z=0, joints={"shoulder": 0.5}))
    free.run(1.0)
    assert abs(positions(free)[0] - 0.5) > 0.1


def test_initial_values_are_where_the_robot_starts(make: Make) -> None:
    initial = '<param name="initial_value">0.7</param>'
    simulator = make(TRAJECTORIES, initial=initial)
    assert positions(simulator) == pytest.approx((0.7, 0.0))
    simulator.run(1.0)
    assert positions(simulator) == pytest.approx((0.7, 0.0), abs=1e-6)
    chosen = make(TRAJECTORIES, initial=initial, spawn=Spawn(z=0, joints={"shoulder": -0.2}))
    assert positions(chosen)[0] == pytest.approx(-0.2)


def test_namespace_of_the_plugin(make: Make) -> None:
    simulator = make(TRAJECTORIES, more="<ros><namespace>left</namespace></ros>")
    names = {topic.name for topic in simulator.bus.topics}
    assert {"/left/joint_states", "/left/arm_controller/joint_trajectory"} <= names
    assert [status.namespace for status in simulator.controllers.list()] == ["/left", "/left"]
    assert {status.state for status in simulator.controllers.list()} == {"active"}


def test_only_the_first_of_two_that_want_a_joint_is_started(make: Make) -> None:
    notes: list[str] = []
    more = "    late: {type: position_controllers/JointGroupPositionController}\n"
    yaml = (
        TRAJECTORIES.replace("\narm_controller:", more + "\narm_controller:")
        + "late: {ros__parameters: {joints: [elbow]}}\n"
    )
    simulator = make(yaml, note=notes.append)
    assert [status.state for status in simulator.controllers.list()] == ["active", "active", "inactive"]
    late = "not started: controller `late` needs joint `elbow`, which `arm_controller` controls; stop one of the two"
    assert [note for note in notes if re.match(r"\S+yaml:\d+:\d+: " + re.escape(late), note)]
    simulator.controllers.switch(start=["late"], stop=["arm_controller"])
    assert [status.state for status in simulator.controllers.list()] == ["active", "inactive", "active"]


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("elbow]", "elbo]", "arm.yaml:10:24: no joint `elbo` in robot `arm`; did you mean `elbow`?"),
        ("[position]\n", "[velocity]\n", "arm.yaml:11:26: joint `shoulder` accepts position, not velocity"),
        ("[position]\n", "[positon]\n", "arm.yaml:11:26: unknown interface `positon`; did you mean `position`?"),
        ("    joints: [shoulder, elbow]\n", "", "arm.yaml:8:1: `arm_controller` has no `joints`"),
        ("JointTrajectoryController\n", "JointTrajectoryControler\n", "did you mean `joint_trajectory_controller/J"),
        ("update_rate: 100", "update_rate: fast", "arm.yaml:3:18: `update_rate` is `fast`"),
    ],
)
def test_wrong_parameters_are_refused_at_their_place(make: Make, old: str, new: str, message: str) -> None:
    assert old in TRAJECTORIES
    with pytest.raises(UrdfkitError) as caught:
        make(TRAJECTORIES.replace(old, new), strict=True)
    assert message in str(caught.value)


def test_missing_files_are_refused_at_their_place(make: Make) -> None:
    with pytest.raises(SimulationError, match=r"arm\.urdf:\d+:\d+: no file .*; did you mean `arm.yaml`"):
        make(TRAJECTORIES, path="$(find arm_bringup)/config/arms.yaml", strict=True)
    with pytest.raises(SimulationError, match=r"no package `arm_bringp`.*did you mean `arm_bringup`"):
        make(TRAJECTORIES, path="$(find arm_bringp)/config/arm.yaml", strict=True)


def test_a_file_that_installing_would_move_is_found_in_the_sources(make: Make, tmp_path: Path) -> None:
    moved = tmp_path / "arm_bringup" / "bringup" / "config" / "other.yaml"
    moved.parent.mkdir(parents=True)
    moved.write_text(TRAJECTORIES)
    simulator = make(BOSS, path="$(find arm_bringup)/config/other.yaml")
    assert [status.name for status in simulator.controllers.list()] == ["joint_state_broadcaster", "arm_controller"]


@pytest.mark.parametrize(
    ("old", "new", "message", "code"),
    [
        ("elbow]", "elbo]", "no joint `elbo` in robot `arm`; did you mean `elbow`?", "K959"),
        (
            "JointTrajectoryController\n",
            "JointTrajectoryControler\n",
            "did you mean `joint_trajectory_controller/J",
            "K962",
        ),
    ],
)
def test_a_controller_with_a_wrong_parameter_is_left_out(
    make: Make, old: str, new: str, message: str, code: str
) -> None:
    simulator = make(TRAJECTORIES.replace(old, new))
    simulator.run(0.1)
    states = {status.name: status.state for status in simulator.controllers.list()}
    assert states == {"joint_state_broadcaster": "active", "arm_controller": "unloaded"}
    (repair,) = simulator.repairs
    assert (repair.kind, repair.code) == ("controller", code)
    assert contains(repair.message, message)
    assert "; controller `arm_controller` is ignored; did you mean" in repair.message
    assert "arm.yaml:" in str(repair)


def test_a_plugin_with_a_wrong_parameter_is_left_out(make: Make) -> None:
    simulator = make(TRAJECTORIES, path="$(find arm_bringup)/config/arms.yaml")
    simulator.run(0.1)
    (repair,) = simulator.repairs
    assert repair.kind == "plugin"
    assert "did you mean `arm.yaml`" in repair.message
    assert simulator.controllers.list() == ()


def test_hardware_of_the_real_robot_is_left_out(make: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    notes: list[str] = []
    simulator = make(TRAJECTORIES, (GZ[0], GZ[1], "arm_driver/ArmHardware"), note=notes.append)
    simulator.run(0.1)
    (hardware,) = simulator.repairs
    assert (hardware.kind, hardware.code) == ("hardware", "C709")
    assert hardware.message == "hardware `arm_driver/ArmHardware` is not the simulator's; its joints are not controlled"
    assert any(
        "its hardware `arm_driver/ArmHardware` is ignored; controller `arm_controller`" in each for each in notes
    )
    monkeypatch.setattr(ros2_control, "simulation_hint", lambda robot: "pass sim_mode:=true")
    with pytest.raises(SimulationError, match="`arm_driver/ArmHardware` is not the simulator's; pass sim_mode:=true"):
        make(TRAJECTORIES, (GZ[0], GZ[1], "arm_driver/ArmHardware"), strict=True)


def test_mock_hardware_is_an_ideal_actuator(make: Make) -> None:
    simulator = make(TRAJECTORIES, (GZ[0], GZ[1], "mock_components/GenericSystem"))
    goals = Goals(simulator)
    goals.send((1.0, [0.5, -0.5]))
    simulator.run(1.5)
    assert simulator.repairs == ()
    assert positions(simulator) == pytest.approx((0.5, -0.5), abs=1e-3)


def test_the_arguments_that_enable_the_simulation_are_listed(tmp_path: Path) -> None:
    path = tmp_path / "arm.urdf.xacro"
    path.write_text(
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg default="false" name="sim_gazebo"/>'
        '<xacro:arg name="simple" default="false"/><xacro:arg name="use_sim" default="true"/>'
        '<!-- <xacro:arg name="use_gazebo" default="false"/> --><link name="a"/></robot>'
    )
    assert simulation_hint(load(path)) == "pass sim_gazebo:=true"
    assert simulation_hint(load(path, arguments={"sim_gazebo": "false"})) == ""


def test_arguments_of_included_files_are_listed_too(tmp_path: Path) -> None:
    xacro = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
    (tmp_path / "arguments.xacro").write_text(f'<robot {xacro}><xacro:arg name="sim_mode" default="false"/></robot>')
    path = tmp_path / "r.urdf.xacro"
    path.write_text(f'<robot name="r" {xacro}><xacro:include filename="arguments.xacro"/><link name="a"/></robot>')
    assert simulation_hint(load(path)) == "pass sim_mode:=true"


def test_a_block_that_no_plugin_runs_is_left_out_with_a_finding(tmp_path: Path) -> None:
    notes: list[str] = []
    block = BLOCK.format(filename="", name="", hardware=GZ[2], commands="", more="", initial="", path="")
    path = arm_package.write_arm(tmp_path, block[: block.index("<gazebo>")])
    (repair,) = Simulator(path, note=notes.append).repairs
    assert "no plugin runs ros2_control `arm`" in repair.message
    assert str(repair) in notes
    assert (repair.kind, repair.code) == ("hardware", "C718")
    (finding,) = lint(path, select=["C718"])
    assert repair.position is not None
    assert (finding.span.file, finding.line) == (repair.position.file, repair.position.line)
    with pytest.raises(SimulationError, match=r"no plugin runs ros2_control `arm` .*; add <gazebo><plugin filename="):
        Simulator(path, note=notes.append, strict=True)


def test_the_controller_manager_takes_requests(make: Make) -> None:
    simulator = make(TRAJECTORIES, more="<ros><namespace>left</namespace></ros>")
    kind = "controller_manager_msgs/srv/SwitchController_Request"
    for field, state in (("deactivate_controllers", "inactive"), ("activate_controllers", "active")):
        message = from_fields(kind, {field: ["arm_controller"], "strictness": 2})
        simulator.bus.publish("/left/controller_manager/switch_controller", kind, message)
        assert [s.state for s in simulator.controllers.list() if s.name == "arm_controller"] == [state]


FOLLOW = "control_msgs/action/FollowJointTrajectory"
EXECUTING, SUCCEEDED, CANCELED, ABORTED = 2, 4, 5, 6


class Goals:
    """Sends goals as ROS 2 does and keeps what comes back."""

    def __init__(self, simulator: Any) -> None:
        self.base, self.bus = "/arm_controller/follow_joint_trajectory/_action", simulator.bus
        self.results: list[Any] = []
        self.feedback: list[Any] = []
        self.states: list[tuple[int, int]] = []
        simulator.subscribe(f"{self.base}/get_result", f"{FOLLOW}_GetResult_Response", self.results.append)
        simulator.subscribe(f"{self.base}/feedback", f"{FOLLOW}_FeedbackMessage", self.feedback.append)
        simulator.subscribe(f"{self.base}/status", "action_msgs/msg/GoalStatusArray", self._state)

    def _state(self, message: Any) -> None:
        self.states += [(int(each.goal_info.goal_id.uuid[-1]), each.status) for each in message.status_list]

    def send(self, *points: tuple[float, list[float]], number: int = 7, **more: Any) -> None:
        kind = f"{FOLLOW}_SendGoal_Request"
        message = from_fields(kind, {"goal_id": {"uuid": [0] * 15 + [number]}, "goal": more})
        message.goal.trajectory = trajectory(*points)
        self.bus.publish(f"{self.base}/send_goal", kind, message)

    def cancel(self, number: int = 0) -> None:
        kind = "action_msgs/srv/CancelGoal_Request"
        message = from_fields(kind, {"goal_info": {"goal_id": {"uuid": [0] * 15 + [number]}}})
        self.bus.publish(f"{self.base}/cancel_goal", kind, message)


def test_a_goal_has_the_names_and_states_of_ros_2(make: Make) -> None:
    simulator = make(TRAJECTORIES, CLASSIC)
    goals = Goals(simulator)
    goals.send((1.0, [0.5, -0.5]))
    assert goals.states == [(7, EXECUTING)]
    simulator.run(1.5)
    assert goals.states == [(7, EXECUTING), (7, SUCCEEDED)]
    assert [(each.status, each.result.error_code) for each in goals.results] == [(SUCCEEDED, 0)]
    assert positions(simulator) == pytest.approx((0.5, -0.5), abs=1e-3)
    assert len(goals.feedback) == 20  # action_monitor_rate
    assert goals.feedback[9].goal_id.uuid[-1] == 7
    assert goals.feedback[9].feedback.desired.positions == pytest.approx([0.25, -0.25], abs=1e-9)
    names = [topic.name for topic in simulator.bus.topics if "follow_joint_trajectory" in topic.name]
    assert {name.rpartition("/_action/")[2] for name in names} == {
        "send_goal", "cancel_goal", "get_result", "status", "feedback"
    }  # fmt: skip


def test_goals_are_cancelled_replaced_aborted_and_refused(make: Make) -> None:
    notes: list[str] = []
    simulator = make(TRAJECTORIES, CLASSIC, note=notes.append)
    goals = Goals(simulator)
    goals.send((1.0, [1.0, 0.0]), number=1)
    simulator.run(0.5)
    goals.cancel(2)
    assert goals.results == []
    goals.cancel(1)
    assert goals.states[-1] == (1, CANCELED)
    simulator.run(0.5)
    assert positions(simulator)[0] == pytest.approx(0.5, abs=0.02)
    goals.send((1.0, [0.4, 0.0]), number=0)  # nobody names it: the count does
    goals.send((1.0, [0.3, 0.0]), number=3)
    assert goals.states[-3:] == [(2, EXECUTING), (2, CANCELED), (3, EXECUTING)]
    goals.cancel()
    assert goals.states[-1] == (3, CANCELED)
    goals.send((0.2, [2.5, 0.0]), number=4, path_tolerance=[{"name": "shoulder", "position": 0.01}])
    simulator.run(1.0)
    assert goals.states[-1] == (4, ABORTED)
    assert goals.results[-1].result.error_code == -4
    told = len(goals.states), len(goals.results)
    goals.send((1.0, [float("nan"), 0.0]), number=5)
    assert (len(goals.states), len(goals.results)) == told
    assert any("rejected a goal" in note for note in notes)


def mock_arm(folder: Path, *files: tuple[str, str], gazebo: str = "") -> Path:
    """Write an arm with mock hardware and no plugin that runs it, in a package with parameter files."""
    block = BLOCK.format(
        filename="", name="", more="", path="", hardware="mock_components/GenericSystem",
        commands=command("position"), initial='<param name="initial_value">0.4</param>',
    )  # fmt: skip
    path = arm_package.write_arm(folder, block[: block.index("<gazebo>")] + gazebo)
    config = next(each for each in path.parents if (each / "package.xml").is_file()) / "config"
    config.mkdir(exist_ok=True)
    for name, text in files:
        (config / name).write_text(text)
    return path


def test_mock_hardware_needs_no_plugin(tmp_path: Path) -> None:
    notes: list[str] = []
    path = mock_arm(tmp_path, ("arm.yaml", TRAJECTORIES), ("other.yaml", "node: {ros__parameters: {a: 1}}"))
    simulator = Simulator(path, note=notes.append, strict=True)
    assert positions(simulator) == pytest.approx((0.4, 0.0))
    assert [note for note in notes if "controllers of ros2_control `arm`: " in note and note.endswith("arm.yaml")]
    Goals(simulator).send((1.0, [0.5, -0.5]))
    simulator.run(1.5)
    assert positions(simulator) == pytest.approx((0.5, -0.5), abs=1e-3)
    assert lint(path, select=["C718"], target="urdfkit") == []


def test_mock_joints_without_controllers_stay_where_they_start(tmp_path: Path) -> None:
    notes: list[str] = []
    simulator = Simulator(mock_arm(tmp_path), note=notes.append, strict=True)
    simulator.run(1.0)
    assert positions(simulator) == pytest.approx((0.4, 0.0), abs=1e-6)
    assert any("no controllers: no YAML file" in note and "--controllers" in note for note in notes)


def test_of_several_parameter_files_of_mock_hardware_none_is_guessed(tmp_path: Path) -> None:
    notes: list[str] = []
    path = mock_arm(tmp_path, ("a.yaml", TRAJECTORIES), ("b.yaml", TRAJECTORIES))
    Simulator(path, note=notes.append, strict=True)
    assert any("2 files configure some" in note and "a.yaml or " in note for note in notes)
    chosen = path.parents[1] / "config" / "b.yaml"
    simulator = Simulator(path, note=notes.append, controllers=[chosen])
    Goals(simulator).send((1.0, [0.5, -0.5]))
    simulator.run(1.5)
    assert positions(simulator) == pytest.approx((0.5, -0.5), abs=1e-3)


def test_mock_hardware_beside_a_drive_of_gazebo_is_left_out(tmp_path: Path) -> None:
    drive = '<gazebo><plugin name="move" filename="libgazebo_ros_planar_move.so"/></gazebo>'
    path = mock_arm(tmp_path, gazebo=drive)
    (repair,) = Simulator(path, note=lambda _: None).repairs
    assert repair.code == "C718"
    (finding,) = lint(path, select=["C718"], target="urdfkit")
    assert repair.position is not None
    assert (finding.span.file, finding.line) == (repair.position.file, repair.position.line)
