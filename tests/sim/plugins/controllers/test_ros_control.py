"""gazebo_ros_control: transmissions, controllers from launch files, PID, limits, the controller manager, errors."""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from pkgutil import iter_modules
from typing import Any

import pytest

from tests.sim import arm_package
from urdfkit import lint
from urdfkit.description.control.controller_types import NOT_SIMULATED, SIMULATED
from urdfkit.errors import SimulationError, UrdfkitError
from urdfkit.messages import FLOAT, FLOATS, JOINT_CONTROLLER_STATE, JOINT_STATE, TRAJECTORY, from_fields
from urdfkit.sim import Simulator, Spawn
from urdfkit.sim.plugins.controllers.controller import RosController
from urdfkit.sim.plugins.controllers.controller_types import ROS_CONTROLLERS

STATES = "  states: {type: joint_state_controller/JointStateController, publish_rate: 50}\n"
PID = "{p: 100.0, i: 50.0, d: 10.0, i_clamp: 20.0}"
POSITIONS = f"""arm:
{STATES}
  a: {{type: effort_controllers/JointPositionController, joint: shoulder, pid: {PID}}}
  b: {{type: effort_controllers/JointPositionController, joint: elbow, pid: {PID}}}
"""
Make = Callable[..., Any]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    def build(yaml: str, interfaces: tuple[str, str] = ("Effort", "Effort"), spawned: tuple[str, ...] = (),
              arm: dict[str, Any] | None = None, **options: Any) -> Any:  # fmt: skip
        arm_package.write_control(tmp_path, yaml, *spawned)
        urdf = arm_package.write_arm(tmp_path, arm_package.transmissions(*interfaces), **(arm or {}))
        options.setdefault("note", lambda _: None)
        return Simulator(urdf, **options)

    return build


def send(simulator: Any, topic: str, value: float) -> None:
    simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": value}))


def positions(simulator: Any) -> tuple[float, float]:
    return simulator.state.position("shoulder"), simulator.state.position("elbow")


def gravity_torque(shoulder: float, elbow: float) -> tuple[float, float]:
    """What holds two links of 1 kg and 0.4 m, centres half way, at these angles from upright [N·m]."""
    g = 9.81
    fore = 0.2 * math.sin(shoulder + elbow)
    return -g * (0.2 * math.sin(shoulder) + 0.4 * math.sin(shoulder) + fore), -g * fore


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_pid_with_integral_holds_a_pose_under_gravity(make: Make, dt: float) -> None:
    simulator = make(POSITIONS, dt=dt)
    send(simulator, "/arm/a/command", 1.0)
    send(simulator, "/arm/b/command", -0.5)
    simulator.run(15.0)
    assert positions(simulator) == pytest.approx((1.0, -0.5), abs=1e-3)
    efforts = simulator.state.effort("shoulder"), simulator.state.effort("elbow")
    assert efforts == pytest.approx(gravity_torque(1.0, -0.5), abs=0.02)


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_without_integral_it_sags_by_what_the_stiffness_gives(make: Make, dt: float) -> None:
    simulator = make(POSITIONS.replace("i: 50.0", "i: 0.0"), dt=dt)
    send(simulator, "/arm/a/command", 1.0)
    send(simulator, "/arm/b/command", -0.5)
    simulator.run(10.0)
    a, b = positions(simulator)
    assert (100 * (1.0 - a), 100 * (-0.5 - b)) == pytest.approx(gravity_torque(a, b), abs=1e-3)


def test_integral_without_clamp_does_nothing_and_is_noted(make: Make) -> None:
    notes: list[str] = []
    simulator = make(POSITIONS.replace(", i_clamp: 20.0", ""), note=notes.append)
    send(simulator, "/arm/a/command", 1.0)
    simulator.run(5.0)
    assert abs(positions(simulator)[0] - 1.0) > 0.05
    assert [note.rpartition("/")[2] for note in notes if "i_clamp" in note] == [
        "arm.yaml: `i` has no effect without `i_clamp`, which defaults to 0"
    ]


def test_efforts_stay_within_the_limit_and_windup_within_the_clamp(make: Make) -> None:
    simulator = make(POSITIONS.replace("i_clamp: 20.0", "i_clamp: 3.0, antiwindup: true"), arm={"effort": 4.0})
    send(simulator, "/arm/a/command", 1.2)  # 4 N·m cannot hold that
    send(simulator, "/arm/b/command", 0.5)
    largest = 0.0
    for _ in range(300):
        simulator.run(0.01)
        largest = max(largest, abs(simulator.state.effort("shoulder")))
    assert largest == pytest.approx(4.0, abs=1e-9)
    # 3 s of a large error would have wound the integral up; its clamp lets it turn round at once.
    error = 1.2 - simulator.state.position("shoulder")
    assert abs(error) > 0.2
    engine = simulator.world.builder.engine
    assert engine.ki[0] == 50.0
    assert 0.0 < abs(engine.integral[0]) <= 3.0 / 50.0 + 1e-12


def test_commands_beyond_a_limit_end_there(make: Make) -> None:
    simulator = make(POSITIONS, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 4.0)
    furthest = 0.0
    for _ in range(500):
        simulator.run(0.01)
        furthest = max(furthest, simulator.state.position("shoulder"))
    assert furthest <= 2.5 + 1e-4
    assert positions(simulator)[0] == pytest.approx(2.5, abs=1e-3)


def test_a_strong_effort_does_not_break_a_limit(make: Make) -> None:
    yaml = "arm:\n  a: {type: effort_controllers/JointEffortController, joint: shoulder}\n"
    simulator = make(yaml, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 1000.0)
    for _ in range(200):
        simulator.run(0.01)
        assert simulator.state.position("shoulder") <= 2.5 + 1e-4
    assert simulator.state.position("shoulder") == pytest.approx(2.5, abs=1e-4)


def test_a_continuous_joint_takes_the_short_way(make: Make) -> None:
    simulator = make(POSITIONS, arm={"elbow": "continuous"}, gravity=(0, 0, 0), spawn=Spawn(z=0, joints={"elbow": 3.0}))
    send(simulator, "/arm/b/command", -3.0)
    simulator.run(8.0)
    assert simulator.state.position("elbow") == pytest.approx(2 * math.pi - 3.0, abs=1e-3)


def test_state_of_a_controller(make: Make) -> None:
    simulator = make(POSITIONS)
    seen: list[Any] = []
    simulator.subscribe("/arm/a/state", JOINT_CONTROLLER_STATE, seen.append)
    send(simulator, "/arm/a/command", 0.3)
    simulator.run(0.1)
    assert len(seen) == 10
    last = seen[-1]
    assert (last.set_point, last.p, last.i, last.d, last.i_clamp) == (0.3, 100.0, 50.0, 10.0, 20.0)
    assert last.process_value == simulator.state.position("shoulder")
    assert last.error == pytest.approx(0.3 - last.process_value)
    assert last.header.stamp.nanosec == 100_000_000


def test_joint_states_at_their_rate_in_alphabetical_order(make: Make) -> None:
    simulator = make(POSITIONS)
    seen: list[Any] = []
    simulator.subscribe("/arm/joint_states", JOINT_STATE, seen.append)
    simulator.run(1.0)
    assert len(seen) == 50
    assert seen[-1].name == ["elbow", "shoulder"]
    assert not any(topic.name == "/joint_states" for topic in simulator.bus.topics)


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_position_interface_without_gains_ignores_gravity_and_keeps_the_velocity_limit(make: Make, dt: float) -> None:
    yaml = "arm:\n  a: {type: position_controllers/JointPositionController, joint: shoulder}\n"
    simulator = make(yaml, ("Position", "Position"), arm={"effort": 0.1}, dt=dt)
    send(simulator, "/arm/a/command", 2.0)
    simulator.run(0.25)
    assert positions(simulator) == pytest.approx((1.0, 0.0), abs=4.1 * dt)  # at 4 rad/s; the elbow is held
    simulator.run(1.0)
    assert positions(simulator) == pytest.approx((2.0, 0.0), abs=1e-6)


def test_a_pid_that_nobody_reads_is_noted_once(make: Make) -> None:
    notes: list[str] = []
    law = "{{type: position_controllers/JointPositionController, joint: {}, pid: {{p: 100.0}}}}"
    yaml = f"arm:\n  a: {law.format('shoulder')}\n  b: {law.format('elbow')}\n"
    make(yaml, ("Position", "Position"), note=notes.append)
    assert len([note for note in notes if "does not read `pid`" in note]) == 1
    gains = "  gazebo_ros_control: {pid_gains: {shoulder: {p: 9.0}, elbow: {p: 9.0}}}\n"
    notes.clear()
    make(yaml + gains, ("Position", "Position"), note=notes.append)
    assert not [note for note in notes if "does not read `pid`" in note]


def test_position_interface_with_gains_is_a_pid(make: Make) -> None:
    yaml = (
        "arm:\n  a: {type: position_controllers/JointPositionController, joint: shoulder}\n"
        "  gazebo_ros_control:\n    pid_gains:\n      shoulder: {p: 100.0, d: 10.0}\n      elbow: {p: 100.0, d: 10.0}\n"
    )
    simulator = make(yaml, ("Position", "Position"))
    send(simulator, "/arm/a/command", 1.0)
    simulator.run(10.0)
    a, b = positions(simulator)
    assert (100 * (1.0 - a), 100 * (0.0 - b)) == pytest.approx(gravity_torque(a, b), abs=1e-3)


def test_velocity_interface_with_and_without_gains(make: Make) -> None:
    yaml = (
        "arm:\n  a: {type: velocity_controllers/JointVelocityController, joint: shoulder}\n"
        "  b: {type: velocity_controllers/JointVelocityController, joint: elbow}\n"
        "  gazebo_ros_control: {pid_gains: {elbow: {p: 50.0, i: 10.0, i_clamp: 5.0, d: 1.0}}}\n"
    )
    simulator = make(yaml, ("Velocity", "Velocity"), gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 0.5)
    send(simulator, "/arm/b/command", -0.25)
    simulator.run(2.0)
    rates = simulator.state.velocity("shoulder"), simulator.state.velocity("elbow")
    assert rates == pytest.approx((0.5, -0.25), abs=1e-3)


def test_velocity_pid_with_a_large_derivative_is_stable(make: Make) -> None:
    yaml = (
        "arm:\n  a: {type: effort_controllers/JointVelocityController, joint: shoulder, "
        "pid: {p: 100.0, i: 0.01, d: 10.0}}\n"
    )
    simulator = make(yaml, dt=0.005, gravity=(0, 0, 0))
    simulator.run(0.5)
    assert simulator.state.velocity("shoulder") == pytest.approx(0.0, abs=1e-9)
    send(simulator, "/arm/a/command", 0.5)
    simulator.run(3.0)
    assert simulator.state.velocity("shoulder") == pytest.approx(0.5, abs=0.01)


def test_velocity_controller_that_goes_to_positions(make: Make) -> None:
    yaml = (
        "arm:\n  a: {type: velocity_controllers/JointPositionController, joint: shoulder, "
        "pid: {p: 5.0, i: 0.0, d: 0.0}}\n"
    )
    simulator = make(yaml, ("Velocity", "Velocity"))
    send(simulator, "/arm/a/command", 1.0)
    simulator.run(4.0)
    assert simulator.state.position("shoulder") == pytest.approx(1.0, abs=1e-6)


def test_groups(make: Make) -> None:
    pid = "{p: 100.0, i: 50.0, d: 10.0, i_clamp: 20.0}"
    yaml = (
        "arm:\n  g: {type: effort_controllers/JointGroupPositionController, joints: [elbow, shoulder], "
        f"elbow: {{pid: {pid}}}, shoulder: {{pid: {pid}}}}}\n"
    )
    notes: list[str] = []
    simulator = make(yaml, note=notes.append)
    simulator.bus.publish("/arm/g/command", FLOATS, from_fields(FLOATS, {"data": [1.0]}))
    simulator.bus.publish("/arm/g/command", FLOATS, from_fields(FLOATS, {"data": [0.4, -0.6]}))
    simulator.run(12.0)
    assert positions(simulator) == pytest.approx((-0.6, 0.4), abs=1e-3)
    assert any("2 finite values are expected" in note for note in notes)


def trajectory(points: list[tuple[float, list[float]]], velocities: bool = False) -> Any:
    rates = {"velocities": [0.0, 0.0]} if velocities else {}
    fields = [
        {"positions": p, "time_from_start": {"sec": int(t), "nanosec": round(t % 1 * 1e9)}, **rates} for t, p in points
    ]
    return from_fields(TRAJECTORY, {"joint_names": ["shoulder", "elbow"], "points": fields})


@pytest.mark.parametrize("kind", ["position", "velocity", "effort"])
def test_trajectories(make: Make, kind: str) -> None:
    pid = "{p: 300.0, d: 30.0, i: 300.0, i_clamp: 20.0}"
    gains = f"gains: {{shoulder: {pid}, elbow: {pid}}}"
    if kind == "velocity":
        gains = "gains: {shoulder: {p: 10.0}, elbow: {p: 10.0}}"
    what = f"type: {kind}_controllers/JointTrajectoryController\n    joints: [shoulder, elbow]"
    yaml = f"arm:\n  t:\n    {what}\n    {gains}\n"
    simulator = make(yaml, (kind.capitalize(), kind.capitalize()))
    message = trajectory([(1.0, [0.5, -0.5]), (2.0, [1.0, 0.0])], velocities=True)
    simulator.at(0.5, lambda: simulator.bus.publish("/arm/t/command", TRAJECTORY, message))
    simulator.run(1.0)
    near = {"position": 2e-3, "velocity": 2e-2, "effort": 0.1}[kind]
    assert positions(simulator) == pytest.approx((0.25, -0.25), abs=near)  # half way of a cubic at rest at both ends
    simulator.run(0.5)
    assert positions(simulator) == pytest.approx((0.5, -0.5), abs=near)
    simulator.run(8.0)
    assert positions(simulator) == pytest.approx((1.0, 0.0), abs=1e-3)


def test_a_trajectory_that_cannot_be_followed_is_dropped_with_a_note(make: Make) -> None:
    notes: list[str] = []
    yaml = "arm:\n  t: {type: position_controllers/JointTrajectoryController, joints: [shoulder, elbow]}\n"
    simulator = make(yaml, ("Position", "Position"), note=notes.append)
    wrong = trajectory([(1.0, [0.5, -0.5])])
    wrong.joint_names = ["shoulder", "elbw"]
    late = trajectory([(1.0, [0.5, -0.5]), (1.0, [0.6, -0.5])])
    for message in (wrong, late):
        simulator.bus.publish("/arm/t/command", TRAJECTORY, message)
    simulator.run(1.5)
    assert positions(simulator) == pytest.approx((0, 0), abs=1e-9)
    assert any("unknown joint `elbw`; did you mean `elbow`?" in note for note in notes)
    assert any("point 2 must be later than the previous point" in note for note in notes)


# Limits (joint_limits_interface)

GAINS = "  gazebo_ros_control: {pid_gains: {shoulder: {p: 400.0, d: 40.0}, elbow: {p: 400.0, d: 40.0}}}\n"
SAFETY = '<safety_controller soft_lower_limit="-0.5" soft_upper_limit="0.5" k_position="5" k_velocity="20"/>'


def law(kind: str, joint: str = "shoulder") -> str:
    return f"arm:\n  a: {{type: {kind}, joint: {joint}}}\n"


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_a_position_command_moves_at_the_velocity_limit_with_gains_too(make: Make, dt: float) -> None:
    yaml = law("position_controllers/JointPositionController") + GAINS
    simulator = make(yaml, ("Position", "Position"), arm={"velocity": 0.5}, gravity=(0, 0, 0), dt=dt)
    send(simulator, "/arm/a/command", 1.0)
    fastest = 0.0
    for _ in range(200):
        simulator.run(0.01)
        fastest = max(fastest, simulator.state.velocity("shoulder"))
        assert simulator.state.position("shoulder") <= 0.5 * simulator.t + 1e-3
    assert fastest == pytest.approx(0.5, rel=0.1)
    simulator.run(1.0)
    assert simulator.state.position("shoulder") == pytest.approx(1.0, abs=1e-4)


def test_soft_limits_slow_a_position_down_and_end_it(make: Make) -> None:
    """Near the soft limit the command comes nearer by k_position times what is left in every second."""
    yaml = law("position_controllers/JointPositionController")
    simulator = make(yaml, ("Position", "Position"), arm={"safety": SAFETY}, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 2.0)
    simulator.run(0.3)
    left = 0.5 - simulator.state.position("shoulder")
    simulator.run(0.2)
    assert 0.5 - simulator.state.position("shoulder") == pytest.approx(left * math.exp(-5 * 0.2), rel=0.02)
    simulator.run(3.0)
    assert simulator.state.position("shoulder") == pytest.approx(0.5, abs=1e-6)


def test_soft_limits_slow_a_velocity_down(make: Make) -> None:
    yaml = law("velocity_controllers/JointVelocityController")
    simulator = make(yaml, ("Velocity", "Velocity"), arm={"safety": SAFETY}, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 1.0)
    simulator.run(4.0)
    assert simulator.state.position("shoulder") == pytest.approx(0.5, abs=1e-4)


@pytest.mark.parametrize("k_velocity", [20, 20_000])  # the inertia of the joint allows about 2000 in explicit steps
def test_soft_limits_hold_an_effort_back(make: Make, k_velocity: int) -> None:
    yaml = law("effort_controllers/JointEffortController")
    safety = SAFETY.replace('k_velocity="20"', f'k_velocity="{k_velocity}"')
    simulator = make(yaml, ("Effort", "Position"), arm={"safety": safety}, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 3.0)
    furthest = 0.0
    for _ in range(600):
        simulator.run(0.01)
        furthest = max(furthest, simulator.state.position("shoulder"))
    assert furthest < 0.5 + 1e-3
    assert simulator.state.position("shoulder") == pytest.approx(0.5, abs=1e-3)
    assert simulator.state.effort("shoulder") == pytest.approx(0.0, abs=0.1)


def test_an_effort_makes_no_joint_faster_than_it_may_be(make: Make) -> None:
    yaml = law("effort_controllers/JointEffortController", "elbow")
    simulator = make(yaml, ("Position", "Effort"), arm={"elbow": "continuous", "velocity": 2.0}, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 1.0)
    fastest = 0.0
    for _ in range(300):
        simulator.run(0.01)
        fastest = max(fastest, simulator.state.velocity("elbow"))
    assert fastest == pytest.approx(2.0, abs=0.03)
    assert simulator.state.velocity("elbow") == pytest.approx(2.0, abs=0.03)


PID_LAWS = {
    "position": "{type: effort_controllers/JointPositionController, joint: JOINT, pid: {p: 40.0, d: 4.0}}",
    "integral": "{type: effort_controllers/JointPositionController, joint: JOINT, "
    "pid: {p: 40.0, d: 4.0, i: 20.0, i_clamp: 2.0, antiwindup: true}}",
    "group": "{type: effort_controllers/JointGroupPositionController, joints: [JOINT], "
    "JOINT: {pid: {p: 40.0, d: 4.0}}}",
    "trajectory": "{type: effort_controllers/JointTrajectoryController, joints: [JOINT], "
    "gains: {JOINT: {p: 40.0, d: 4.0}}}",
}


def pid_law(kind: str, joint: str) -> str:
    return f"arm:\n  a: {PID_LAWS[kind].replace('JOINT', joint)}\n"


def want(simulator: Any, kind: str, joint: str, value: float) -> None:
    """Command a position, whatever the controller takes it by."""
    if kind == "group":
        simulator.bus.publish("/arm/a/command", FLOATS, from_fields(FLOATS, {"data": [value]}))
    elif kind == "trajectory":
        point = {"positions": [value], "time_from_start": {"nanosec": 1_000_000}}
        fields = {"joint_names": [joint], "points": [point]}
        simulator.bus.publish("/arm/a/command", TRAJECTORY, from_fields(TRAJECTORY, fields))
    else:
        send(simulator, "/arm/a/command", value)


@pytest.mark.parametrize("kind", PID_LAWS)
def test_soft_limits_hold_the_effort_of_a_pid_back(make: Make, kind: str) -> None:
    simulator = make(pid_law(kind, "shoulder"), ("Effort", "Position"), arm={"safety": SAFETY}, gravity=(0, 0, 0))
    want(simulator, kind, "shoulder", 2.0)
    furthest = 0.0
    for _ in range(600):
        simulator.run(0.01)
        furthest = max(furthest, simulator.state.position("shoulder"))
    assert furthest < 0.5 + 1e-3
    assert simulator.state.position("shoulder") == pytest.approx(0.5, abs=1e-3)
    want(simulator, kind, "shoulder", 0.2)  # and the servo takes over again
    simulator.run(4.0)
    assert simulator.state.position("shoulder") == pytest.approx(0.2, abs=0.02)


@pytest.mark.parametrize("kind", PID_LAWS)
def test_the_effort_of_a_pid_makes_no_joint_faster_than_it_may_be(make: Make, kind: str) -> None:
    simulator = make(pid_law(kind, "elbow"), ("Position", "Effort"), arm={"velocity": 2.0}, gravity=(0, 0, 0))
    want(simulator, kind, "elbow", 1.5)
    fastest = 0.0
    for _ in range(2000):
        simulator.step()
        fastest = max(fastest, simulator.state.velocity("elbow"))
    # An effort is taken away when the joint is too fast, so it gets as much faster as one control period lets it.
    assert 1.9 < fastest < 2.8
    simulator.run(3.0)
    assert simulator.state.position("elbow") == pytest.approx(1.5, abs=0.05)


def test_a_velocity_pid_is_cut_too(make: Make) -> None:
    yaml = "arm:\n  a: {type: effort_controllers/JointVelocityController, joint: elbow, pid: {p: 2.0}}\n"
    simulator = make(yaml, ("Position", "Effort"), arm={"elbow": "continuous", "velocity": 1.0}, gravity=(0, 0, 0))
    send(simulator, "/arm/a/command", 3.0)
    simulator.run(2.0)
    assert simulator.state.velocity("elbow") == pytest.approx(1.0, abs=0.05)


def test_limits_among_the_parameters_come_first(make: Make) -> None:
    yaml = law("position_controllers/JointPositionController") + (
        "  joint_limits: {shoulder: {has_position_limits: true, min_position: -0.2, max_position: 0.4, "
        "has_velocity_limits: true, max_velocity: 0.5, has_acceleration_limits: true, max_acceleration: 1}}\n"
    )
    notes: list[str] = []
    simulator = make(yaml, ("Position", "Position"), gravity=(0, 0, 0), note=notes.append)
    assert any("acceleration limits of joint `shoulder` are not simulated" in note for note in notes)
    send(simulator, "/arm/a/command", 1.0)
    simulator.run(0.4)
    assert simulator.state.position("shoulder") == pytest.approx(0.2, abs=5e-3)
    simulator.run(1.0)
    assert simulator.state.position("shoulder") == pytest.approx(0.4, abs=1e-6)


def test_kinetic_reads_gains_at_the_root_unless_told_otherwise(make: Make) -> None:
    """DefaultRobotHWSim of Kinetic has no namespace where ``legacyModeNS`` is missing or true."""
    notes: list[str] = []
    below = law("position_controllers/JointPositionController") + GAINS
    above = law("position_controllers/JointPositionController") + GAINS.replace("  gazebo_ros", "gazebo_ros")
    for yaml, distro, sags in ((below, "noetic", True), (below, "kinetic", False), (above, "kinetic", True)):
        notes.clear()
        simulator = make(yaml, ("Position", "Position"), ros_distro=distro, note=notes.append)
        send(simulator, "/arm/a/command", 1.0)
        simulator.run(3.0)
        assert (simulator.state.position("shoulder") > 1.005) is sags
        assert any("Kinetic reads gains at /gazebo_ros_control" in note for note in notes) is (not sags)


# The controller manager


def test_what_is_spawned_is_started_and_the_file_is_named(make: Make) -> None:
    notes: list[str] = []
    simulator = make(POSITIONS, spawned=("states", "a"), note=notes.append)
    states = {status.name: status.state for status in simulator.controllers.list()}
    assert states == {"states": "running", "a": "running", "b": "unloaded"}
    assert any("controllers of /arm" in note and "arm.yaml (loaded by" in note for note in notes)


def test_start_stop_switch_and_conflicts(make: Make) -> None:
    yaml = POSITIONS + "  c: {type: effort_controllers/JointEffortController, joint: shoulder}\n"
    simulator = make(yaml, spawned=("states", "a", "b"))
    with pytest.raises(SimulationError, match="controller `c` needs joint `shoulder`, which `a` controls"):
        simulator.controllers.start("c")
    simulator.controllers.switch(start=["/arm/c"], stop=["a"])
    states = {status.name: (status.state, status.claims) for status in simulator.controllers.list()}
    assert states["a"] == ("stopped", ("shoulder/effort",))
    assert states["c"] == ("running", ("shoulder/effort",))
    send(simulator, "/arm/a/command", 1.0)  # nobody listens
    send(simulator, "/arm/c/command", 2.0)
    simulator.run(0.01)
    assert simulator.state.tau[0] == pytest.approx(2.0)
    simulator.controllers.stop("c")
    simulator.run(0.01)
    assert simulator.state.tau[0] == pytest.approx(0.0, abs=1e-9)
    simulator.controllers.unload("c")
    with pytest.raises(SimulationError, match="controller `b` runs; stop it"):
        simulator.controllers.unload("b")
    with pytest.raises(SimulationError, match="no controller `aa`; did you mean `a`"):
        simulator.controllers.load("aa")


def test_reset_starts_the_controllers_anew(make: Make) -> None:
    simulator = make(POSITIONS)
    send(simulator, "/arm/a/command", 1.0)
    simulator.run(3.0)
    simulator.reset()
    simulator.run(5.0)
    assert positions(simulator) == pytest.approx((0.0, 0.0), abs=1e-3)


def test_same_calls_same_bits_however_they_are_portioned_out(make: Make) -> None:
    at_once, singly = make(POSITIONS), make(POSITIONS)
    singly.subscribe("/arm/joint_states", JOINT_STATE, lambda _: None)
    for simulator in (at_once, singly):
        send(simulator, "/arm/a/command", 1.0)
    at_once.step(400)
    for _ in range(400):
        singly.step()
    assert at_once.state.q.tobytes() == singly.state.q.tobytes()


def ask(simulator: Any, service: str, **fields: Any) -> None:
    kind = f"controller_manager_msgs/srv/{service.title().replace('_', '')}_Request"
    message = from_fields(kind, fields)
    simulator.bus.publish(f"/arm/controller_manager/{service}", kind, message)


def test_the_controller_manager_takes_requests(make: Make) -> None:
    notes: list[str] = []
    yaml = POSITIONS + "  c: {type: effort_controllers/JointEffortController, joint: shoulder}\n"
    simulator = make(yaml, spawned=("states", "a", "b"), note=notes.append)

    def states() -> dict[str, str]:
        return {status.name: status.state for status in simulator.controllers.list()}

    ask(simulator, "load_controller", name="c")
    assert states()["c"] == "stopped"
    ask(simulator, "switch_controller", start_controllers=["c"], strictness=2)
    assert (states()["a"], states()["c"]) == ("running", "stopped")
    assert any("/arm/controller_manager/switch_controller: controller `c` needs joint `shoulder`" in n for n in notes)
    ask(simulator, "switch_controller", start_controllers=["c"], stop_controllers=["a"], strictness=2)
    assert (states()["a"], states()["c"]) == ("stopped", "running")
    ask(simulator, "unload_controller", name="a")
    assert states()["a"] == "unloaded"
    ask(simulator, "switch_controller", start_controllers=["a"], stop_controllers=["nobody", "b"], strictness=1)
    assert (states()["a"], states()["b"], states()["c"]) == ("stopped", "stopped", "running")
    ask(simulator, "unload_controller", name="nobody")
    assert any("/arm/controller_manager/unload_controller: no controller `nobody`" in note for note in notes)


# Files


def test_named_files_take_the_place_of_what_launch_files_load(make: Make, tmp_path: Path) -> None:
    other = tmp_path / "other.yaml"
    other.write_text("only: {type: effort_controllers/JointEffortController, joint: elbow}\n")  # without namespace
    simulator = make(POSITIONS, controllers=[other])
    assert [status.name for status in simulator.controllers.list()] == ["only"]


def test_without_launch_file_the_config_folder_is_read(tmp_path: Path) -> None:
    arm_package.write_control(tmp_path, POSITIONS, launch=False)
    simulator = Simulator(arm_package.write_arm(tmp_path, arm_package.transmissions()), note=lambda _: None)
    assert [status.state for status in simulator.controllers.list()] == ["running"] * 3


def test_without_any_file_it_says_so(tmp_path: Path) -> None:
    notes: list[str] = []
    simulator = Simulator(arm_package.write_arm(tmp_path, arm_package.transmissions()), note=notes.append)
    assert simulator.controllers.list() == ()
    assert any("no controllers for /arm" in note and "--controllers" in note for note in notes)


@pytest.mark.parametrize(
    ("yaml", "place", "message"),
    [
        ("arm:\n  a: {type: effort_controllers/JointEffortController, joint: shoulda}\n",
         "arm.yaml:2:62", "no joint `shoulda` in robot `arm`; did you mean `shoulder`?"),
        ("arm:\n  a: {type: effort_controllers/JointEfortController, joint: shoulder}\n",
         "arm.yaml:2:13", "did you mean `effort_controllers/JointEffortController`?"),
        ("arm:\n  s: {type: joint_state_controller/JointStateController}\n",
         "arm.yaml:2:3", "`s` has no `publish_rate`, which is required"),
        ("arm:\n  a: {type: position_controllers/JointPositionController, joint: shoulder}\n",
         "arm.yaml:2:13", "joint `shoulder` accepts effort, not position; check its <transmission> (rejected: strict)"),
        ("arm:\n  a: {type: effort_controllers/JointPositionController, joint: shoulder}\n",
         "arm.yaml:2:3", "`a` has no `pid`"),
        ("arm:\n  a: {type: effort_controllers/JointPositionController, joint: shoulder, pid: {p: x}}\n",
         "arm.yaml:2:83", "`p` is `x`; it must be a finite number"),
        ("arm:\n  a: {type: effort_controllers/JointPositionController, joint: shoulder, pid: {p: -1}}\n",
         "arm.yaml:2:83", "a negative gain drives the joint away"),
        ("arm:\n  a: {type: effort_controllers/JointEffortController\n", "arm.yaml:3:1", "invalid YAML"),
    ],
)  # fmt: skip
def test_wrong_parameters_are_refused_at_their_place(make: Make, yaml: str, place: str, message: str) -> None:
    with pytest.raises(UrdfkitError) as caught:
        make(yaml, strict=True)
    assert place in str(caught.value)
    assert message in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_transmission_without_interface_is_refused_at_its_place(tmp_path: Path) -> None:
    text = arm_package.transmissions().replace(
        "<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>", ""
    )
    with pytest.raises(SimulationError, match=r"arm\.urdf:\d+:5: transmission `tran_shoulder` lacks <hardwareInterf"):
        Simulator(arm_package.write_arm(tmp_path, text), strict=True)
    odd = arm_package.transmissions("Efort")
    with pytest.raises(SimulationError, match=r"no interface `hardware_interface/EfortJointInterface`; did you mean"):
        Simulator(arm_package.write_arm(tmp_path, odd), strict=True)


FOREIGN = "<hardwareInterface>arm_hw/StateInterface</hardwareInterface>"


@pytest.mark.parametrize(
    ("joints", "problem"),
    [
        (f'<joint name="elbow">{FOREIGN}</joint><joint name="shoulder">{FOREIGN}</joint>', "has 2 joints"),
        (f'<joint name="elbow">{FOREIGN}</joint>', "Gazebo has no interface `arm_hw/StateInterface`"),
        ('<joint name="elbow"/>', "lacks <hardwareInterface> in its <joint>"),
    ],
)
def test_a_transmission_that_gazebo_does_not_simulate_is_left_out_and_lint_reports_it(
    tmp_path: Path, joints: str, problem: str
) -> None:
    odd = f'<transmission name="odd">\n<type>arm_hw/State</type>\n{joints}\n<actuator name="m"/></transmission>\n'
    path = arm_package.write_arm(tmp_path, odd + arm_package.transmissions())
    arm_package.write_control(tmp_path, POSITIONS)
    simulator = Simulator(path, note=lambda _: None)
    (repair,) = simulator.repairs
    assert problem in repair.message
    assert repair.message.endswith("transmission `odd` is ignored")
    assert repair.position is not None
    found = {(finding.line, finding.code) for finding in lint(path)}
    assert {(repair.position.line, "C702"), (repair.position.line, "C703")} & found
    send(simulator, "/arm/a/command", 0.5)
    simulator.run(3.0)
    assert positions(simulator)[0] == pytest.approx(0.5, abs=0.05)


@pytest.mark.parametrize("kind", ["imu_sensor_controller/ImuSensorController", "unitree_legged_control/UnitreeJoint"])
def test_a_controller_we_do_not_simulate_is_noted_and_the_rest_runs(make: Make, kind: str) -> None:
    notes: list[str] = []
    simulator = make(POSITIONS + f"  i: {{type: {kind}}}\n", note=notes.append)
    assert any(f"{kind} is not simulated" in note for note in notes)
    assert [status.state for status in simulator.controllers.list()] == ["running"] * 3 + ["unloaded"]


def test_every_law_is_in_its_tuple() -> None:
    package = import_module("urdfkit.sim.plugins.controllers")
    found = set()
    for module in iter_modules(package.__path__):
        for value in vars(import_module(f"urdfkit.sim.plugins.controllers.{module.name}")).values():
            if isinstance(value, type) and issubclass(value, RosController) and value is not RosController:
                found.add(value)
    assert found == set(ROS_CONTROLLERS)
    names = [name for law in ROS_CONTROLLERS for name in law.types]
    assert len(names) == len(set(names))
    assert sorted(names) == sorted(SIMULATED)
    assert not set(names) & set(NOT_SIMULATED)
