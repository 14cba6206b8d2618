"""The simulator as a library: accuracy of the drive, determinism, time, topics, errors."""

from __future__ import annotations

import math
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from urdfkit.errors import KinematicsError, ResourceError, SimulationError
from urdfkit.messages import CLOCK, JOINT_STATE, ODOMETRY, TF, TWIST
from urdfkit.sim import Simulator, Spawn

Make = Callable[..., Any]


def yaw(pose: tuple[float, ...]) -> float:
    return 2 * math.atan2(pose[5], pose[6])


def unicycle(v: float, w: float, seconds: float) -> tuple[float, float, float]:
    return v / w * math.sin(w * seconds), v / w * (1 - math.cos(w * seconds)), w * seconds


def test_parked_it_stays_where_it_is() -> None:
    simulator = Simulator("simpleton")
    simulator.run(100.0)
    assert np.hypot(*simulator.state.base_pose[:2]) < 1e-9
    assert abs(simulator.state.base_pose[2]) < 1e-9


@pytest.mark.parametrize("dt", [0.001, 0.005])
def test_rolling_wheels_make_an_ideal_unicycle(make: Make, dt: float) -> None:
    v, w, radius, separation = 0.5, 0.5, 0.1, 0.3
    rates = {"left_joint": (v - w * separation / 2) / radius, "right_joint": (v + w * separation / 2) / radius}
    spawn = Spawn(twist=(v, 0, 0, 0, 0, w), velocities=rates)
    simulator = make("ros1", "<odometrySource>encoder</odometrySource>", dt=dt, spawn=spawn)
    simulator.command((v, 0, 0), (0, 0, w))
    simulator.run(10.0)
    x, y, heading = unicycle(v, w, 10.0)
    pose = simulator.state.base_pose
    assert pose[:2] == pytest.approx((x, y), abs=1e-5)
    assert math.remainder(yaw(pose) - heading, 2 * math.pi) == pytest.approx(0, abs=1e-5)
    position, _ = simulator.odometry()["odom"]
    assert position[:2] == pytest.approx((x, y), abs=1e-5)


def test_same_calls_same_bits(make: Make) -> None:
    def drive() -> tuple[bytes, bytes, list[tuple[str, int]]]:
        simulator = make()
        simulator.command((0.4, 0, 0), (0, 0, -0.7))
        simulator.run(2.0)
        counts = [(topic.name, topic.count) for topic in simulator.bus.topics]
        return simulator.state.q.tobytes(), simulator.state.v.tobytes(), counts

    assert drive() == drive()


def test_how_steps_are_portioned_out_does_not_matter(make: Make) -> None:
    at_once, singly, listening = make(), make(), make()
    listening.subscribe("/clock", CLOCK, lambda _: None)
    listening.subscribe("/joint_states", JOINT_STATE, lambda _: None)
    for simulator in (at_once, singly, listening):
        simulator.command((0.4, 0, 0), (0, 0, -0.7))
    at_once.step(500)
    for _ in range(500):
        singly.step()
    listening.step(500)
    assert at_once.state.q.tobytes() == singly.state.q.tobytes() == listening.state.q.tobytes()
    counts = [[(topic.name, topic.count) for topic in s.bus.topics] for s in (at_once, singly, listening)]
    assert counts[0] == counts[1] == counts[2]


def test_simulators_in_threads_do_not_disturb_each_other(make: Make) -> None:
    alone = make()
    alone.command((0.4, 0, 0), (0, 0, 0.7))
    alone.run(1.0)
    simulators = [make(), make()]
    for simulator in simulators:
        simulator.command((0.4, 0, 0), (0, 0, 0.7))
    threads = [threading.Thread(target=simulator.run, args=(1.0,)) for simulator in simulators]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(simulator.state.q.tobytes() == alone.state.q.tobytes() for simulator in simulators)


def test_reset_starts_again(make: Make) -> None:
    simulator = make("ros1", "<odometrySource>encoder</odometrySource>")
    first: list[Any] = []
    for _ in range(2):
        simulator.command((0.4, 0, 0), (0, 0, 0.7))
        simulator.run(1.0)
        first.append((simulator.state.q.tobytes(), simulator.odometry()))
        simulator.reset()
        assert simulator.t == 0.0
    assert first[0] == first[1]
    simulator.run(1.0)
    assert np.hypot(*simulator.state.base_pose[:2]) < 1e-9


def test_paused_it_runs_nowhere_but_steps(make: Make) -> None:
    simulator = make()
    simulator.paused = True
    simulator.run(1.0)
    assert simulator.t == 0.0
    simulator.step(3)
    assert simulator.t == pytest.approx(0.003)


def test_state_cannot_be_written(make: Make) -> None:
    simulator = make()
    with pytest.raises(ValueError, match="read-only"):
        simulator.state.v[0] = 1.0
    with pytest.raises(ValueError, match="read-only"):
        simulator.state.q[0] = 17.0
    assert simulator.state.base_pose[0] == 0.0


def test_calls_come_at_their_time(make: Make) -> None:
    simulator = make()
    times: list[float] = []
    simulator.every(0.25, lambda: times.append(simulator.t))
    simulator.at(0.1001, lambda: times.append(simulator.t))
    simulator.step(1000)
    assert times == pytest.approx([0.0, 0.101, 0.25, 0.5, 0.75])


def test_rates_count_in_simulated_time(make: Make) -> None:
    simulator = make("ros2", "<publish_odom>true</publish_odom><publish_odom_tf>true</publish_odom_tf>", dt=0.003)
    simulator.run(3.0)
    counts = {topic.name: topic.count for topic in simulator.bus.topics}
    assert counts["/odom"] == 300
    assert counts["/joint_states"] == 150
    assert counts["/clock"] == 300
    assert counts["/tf"] == 300 + 150
    assert counts["/tf_static"] == 1


def test_messages_are_stamped_with_simulated_time_and_complete(make: Make) -> None:
    simulator = make("ros1", "<robotBaseFrame>base</robotBaseFrame>")
    seen: dict[str, list[Any]] = {}
    for topic, kind in (("/joint_states", JOINT_STATE), ("/tf", TF), ("/clock", CLOCK)):
        simulator.subscribe(topic, kind, seen.setdefault(topic, []).append)
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(0.1)
    states = seen["/joint_states"]
    assert [message.header.stamp.nanosec for message in states] == [20_000_000 * n for n in range(1, 6)]
    assert states[-1].name == ["left_joint", "right_joint"]
    assert states[-1].velocity == pytest.approx([3.0, 3.0], abs=0.01)
    assert states[-1].position[0] == simulator.state.position("left_joint")
    assert seen["/clock"][-1].clock.nanosec == 100_000_000
    links = {link.child_frame_id: link for message in seen["/tf"] for link in message.transforms}
    assert links["left_wheel"].header.frame_id == "base"
    turned = links["left_wheel"].transform.rotation
    assert 2 * math.atan2(turned.y, turned.w) == pytest.approx(simulator.state.position("left_joint"))
    assert links["base"].header.frame_id == "odom"


def test_what_nobody_listens_to_is_the_same_when_looked_at_later(make: Make) -> None:
    quiet, heard = make(), make()
    heard.subscribe("/rover/odom", ODOMETRY, lambda _: None)
    for simulator in (quiet, heard):
        simulator.command((0.3, 0, 0), (0, 0, 0.3))
        simulator.run(0.5)
    messages = [simulator.bus.latest("/rover/odom") for simulator in (quiet, heard)]
    assert messages[0].pose.pose == messages[1].pose.pose
    assert messages[0].header.stamp == messages[1].header.stamp
    quiet.run(0.004)
    assert quiet.bus.latest("/rover/odom").header.stamp == messages[0].header.stamp


def test_set_down_on_its_lowest_collision_point(make: Make) -> None:
    simulator = make(spawn=Spawn(x=1.0, yaw=0.5))
    assert simulator.state.base_pose[:3] == pytest.approx((1.0, 0.0, 0.0), abs=1e-12)
    flat = make(None, spawn=Spawn(roll=math.pi))
    lowest = flat.state.base_pose[2]
    flat.run(0.5)
    assert lowest == pytest.approx(0.2)
    assert flat.state.base_pose[2] == pytest.approx(0.2, abs=1e-3)
    assert make(world="void").state.base_pose[2] == 0.0


def test_free_fall_and_initial_twist(make: Make) -> None:
    spawn = Spawn(z=10.0, twist=(1.0, 0, 2.0, 0, 0, 0))
    simulator = make(None, world="void", gravity=(0, 0, -1.62), spawn=spawn)
    simulator.run(1.0)
    assert simulator.state.base_pose[:3] == pytest.approx((1.0, 0.0, 10 + 2 - 0.81), abs=2e-3)
    assert simulator.state.base_velocity[:3] == pytest.approx((1.0, 0.0, 0.38), abs=1e-6)


def test_twist_is_along_the_worlds_axes(make: Make) -> None:
    spawn = Spawn(z=5.0, yaw=math.pi / 2, twist=(1.0, 0, 0, 0, 0, 0))
    simulator = make(None, world="void", gravity=(0, 0, 0), spawn=spawn)
    simulator.run(1.0)
    assert simulator.state.base_pose[:3] == pytest.approx((1.0, 0.0, 5.0), abs=1e-9)


def test_a_fixed_base_stays_and_its_links_are_where_it_was_put(make: Make) -> None:
    simulator = make(fixed_base=True, spawn=Spawn(x=1.0, z=2.0, yaw=math.pi / 2))
    simulator.command((0.3, 0, 0), (0, 0, 0))
    simulator.run(0.5)
    assert simulator.state.base_pose[:3] == (1.0, 0.0, 2.0)
    assert simulator.state.velocity("left_joint") == pytest.approx(3.0)
    wheel = simulator.link_poses()[simulator.kinematics.link_names.index("left_wheel")]
    assert wheel[:3] == pytest.approx((1.0 - 0.15, 0.0, 2.1))
    with pytest.raises(SimulationError, match="fixed base cannot have an initial velocity"):
        make(fixed_base=True, spawn=Spawn(twist=(1, 0, 0, 0, 0, 0)))


def test_a_root_link_called_world_is_the_world(write_rover: Callable[..., Path]) -> None:
    joint = '<joint name="j" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>'
    simulator = Simulator(write_rover('<link name="world"/>' + joint))
    simulator.run(0.5)
    base = simulator.link_poses()[simulator.kinematics.link_names.index("base")]
    assert base[:3] == pytest.approx((0, 0, 1))


def test_position_targets_are_reached_and_held(make: Make) -> None:
    simulator = make(None, spawn=Spawn(z=1.0, joints={"left_joint": 0.5}), fixed_base=True)
    simulator.motors.hold("left_joint", -1.0)
    simulator.motors.drive("right_joint", 2.0)
    simulator.run(2.0)
    assert simulator.state.position("left_joint") == pytest.approx(-1.0, abs=1e-6)
    assert simulator.state.position("right_joint") == pytest.approx(4.0, abs=0.01)
    simulator.motors.release("left_joint")
    assert not simulator.motors.has_goals


def test_wrong_targets_are_refused(make: Make) -> None:
    simulator = make()
    with pytest.raises(KinematicsError, match=r"no movable joint `left_joit`.*did you mean `left_joint`"):
        simulator.motors.drive("left_joit", 1.0)
    with pytest.raises(SimulationError, match="invalid motor target"):
        simulator.motors.drive("left_joint", math.nan)
    with pytest.raises(SimulationError, match="must be a finite number"):
        simulator.motors.hold("left_joint", math.inf)
    assert not simulator.motors.has_goals


def test_continuous_joints_count_their_turns(make: Make) -> None:
    simulator = make(fixed_base=True, spawn=Spawn(z=1.0))
    simulator.command((2.0, 0, 0), (0, 0, 0))
    simulator.run(5.0)
    assert simulator.state.position("left_joint") == pytest.approx(100.0, abs=0.1)


def test_a_robot_by_name_with_its_camera_leaves_nothing_to_say() -> None:
    notes: list[str] = []
    Simulator("simpleton", note=notes.append)
    assert notes == []


def test_a_plugin_that_is_not_simulated_is_named(write_rover: Callable[..., Path]) -> None:
    notes: list[str] = []
    gripper = '<gazebo><plugin name="g" filename="libgazebo_ros_vacuum_gripper.so"/></gazebo>'
    Simulator(write_rover(gripper), note=notes.append)
    assert [note.partition(": ")[2] for note in notes] == [
        "plugin `libgazebo_ros_vacuum_gripper.so` is not simulated yet"
    ]


def test_what_cannot_be_simulated_is_reported_with_its_place(write_rover: Callable[..., Path]) -> None:
    arm = '<link name="arm"/><joint name="elbow" type="revolute"><parent link="base"/><child link="arm"/>'
    path = write_rover(f'{arm}<axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>')
    with pytest.raises(SimulationError) as caught:
        Simulator(path, strict=True)
    line = next(n for n, text in enumerate(path.read_text().splitlines(), 1) if "elbow" in text)
    assert f"rover.urdf:{line}:" in str(caught.value)
    assert "link `arm` has no <inertial>, but joint `elbow` moves it" in str(caught.value)
    with pytest.raises(ResourceError, match="did you mean `simpleton`"):
        Simulator("simpletn")


@pytest.mark.parametrize("dt", [0.0, -0.001, math.nan, math.inf, 1.0])
def test_steps_that_make_no_sense(make: Make, dt: float) -> None:
    with pytest.raises(SimulationError, match=f"time step is {dt:g} s; it must be from 1e-6 to 0.1 s"):
        make(dt=dt)


@pytest.mark.parametrize("seconds", [-1.0, math.nan, math.inf])
def test_durations_that_make_no_sense(make: Make, seconds: float) -> None:
    with pytest.raises(SimulationError, match="the duration is"):
        make().run(seconds)


def test_a_robot_without_drive_takes_no_commands(make: Make) -> None:
    simulator = make(None)
    with pytest.raises(SimulationError, match="`rover` has no drive"):
        simulator.command((1, 0, 0), (0, 0, 0))


def test_the_example_of_the_documentation_works(capsys: pytest.CaptureFixture[str]) -> None:
    import urdfkit.sim

    example = (urdfkit.sim.__doc__ or "").split("::\n")[1]
    lines = [line.removeprefix("    ") for line in example.splitlines()]
    assert len([line for line in lines if line.strip()]) <= 10
    code = "\n".join(lines).replace("simulator.run(10.0)", "simulator.run(0.1)")
    exec(compile(code, "example", "exec"), {})
    assert "nav_msgs__msg__Odometry" in capsys.readouterr().out


def test_commands_published_by_others_are_heard(make: Make) -> None:
    from urdfkit.messages import twist

    simulator = make()
    assert simulator.command_topics == ("/rover/cmd_vel",)
    simulator.bus.publish("rover/cmd_vel", TWIST, twist((0.3, 0, 0), (0, 0, 0)))
    simulator.run(0.5)
    assert simulator.state.base_velocity[0] == pytest.approx(0.3)


def chain(path: Path, axes: str) -> Path:
    """Write a robot whose last link alone has a mass, below joints about the given axes."""
    inertia = '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>'
    text = '<robot name="r"><link name="world"/>'
    parent = "world"
    for n, axis in enumerate(axes):
        vector = {"x": "1 0 0", "y": "0 1 0", "z": "0 0 1"}[axis]
        mass = f"<inertial><mass value='1'/>{inertia}</inertial>" if n == len(axes) - 1 else ""
        text += f'\n<link name="l{n}">{mass}</link><joint name="j{n}" type="continuous"><parent link="{parent}"/>'
        text += f'<child link="l{n}"/><axis xyz="{vector}"/></joint>'
        parent = f"l{n}"
    path.write_text(text + "</robot>")
    return path


def test_a_link_without_mass_may_carry_one_about_another_axis(tmp_path: Path) -> None:
    notes: list[str] = []
    simulator = Simulator(chain(tmp_path / "r.urdf", "zyx"), note=notes.append)
    simulator.motors.drive("j1", 1.0)
    simulator.run(0.5)
    assert simulator.state.position("j1") == pytest.approx(0.5, abs=0.01)
    assert [note.split(": ", 1)[1] for note in notes] == [
        f"link `l{n}` has no mass; it moves with its child links" for n in (0, 1)
    ]
    with pytest.raises(SimulationError, match=r"r\.urdf:2:7: link `l0` has no <inertial>, but joint `j0` moves it"):
        Simulator(chain(tmp_path / "s.urdf", "zxx").rename(tmp_path / "r.urdf"), strict=True)


def test_a_servo_keeps_to_the_effort_limit_of_its_joint() -> None:
    arm = Simulator("rrbot", world="void", gravity=(0, 0, 0), note=lambda text: None)
    arm.controllers.stop("joint1_position_controller", "joint2_position_controller")
    joint = next(name for name in arm.kinematics.joint_names if arm.motors.limit(name) < 1e6)
    most = arm.motors.limit(joint)
    for effort, expected in ((None, most), (0.5 * most, 0.5 * most)):
        arm.motors.servo(joint, stiffness=1e6, damping=1.0, position=1.0, effort=effort)
        arm.step()
        assert arm.state.effort(joint) == pytest.approx(expected)
    arm.motors.exert(joint, 1.5)
    arm.step()
    assert arm.state.effort(joint) == pytest.approx(0.5 * most + 1.5)
