"""Odometry that the engine integrates, compared with the same in Python, and with and without subscribers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.bench.peers.sim_run import COMMANDS, InSimRun
from urdfkit.messages import ODOMETRY
from urdfkit.sim import Simulator
from urdfkit.sim.plugins.wheel_odometry import EncoderOdometry
from urdfkit.sim.state.periodic_steps import PeriodicSteps

Make = Callable[..., Any]
ENCODER = "<odometrySource>encoder</odometrySource>"
ROBOTS: dict[str, tuple[str, str]] = {
    "chord": ("ros1", f"{ENCODER}<updateRate>100</updateRate>"),
    "thirty times a second": ("ros1", f"{ENCODER}<updateRate>30</updateRate>"),
    "every step": ("ros1", f"{ENCODER}<updateRate>0</updateRate>"),
    "arc": ("gz", ""),
}
MECANUM = """<gazebo><plugin filename="gz-sim-mecanum-drive-system" name="gz::sim::systems::MecanumDrive">
  <front_left_joint>left_joint</front_left_joint><front_right_joint>right_joint</front_right_joint>
  <back_left_joint>left_joint</back_left_joint><back_right_joint>right_joint</back_right_joint>
  <wheel_separation>0.3</wheel_separation><wheelbase>0.4</wheelbase><wheel_radius>0.1</wheel_radius>
  <topic>cmd_vel</topic></plugin></gazebo>"""


def _agree(simulator: Simulator, steps: int) -> None:
    """Drive a curve, and compare the engine's odometry with that of the same positions in Python."""
    drive, state = simulator._drives[0], simulator.state
    ticks = PeriodicSteps(drive.read_rate, simulator.dt)
    twin = EncoderOdometry(drive.odometry.encoders, axles=drive.odometry.axles, exact=drive.odometry.exact)
    twin.update(0.0, *(state.position(encoder.joint) for encoder in twin.encoders))
    for k in range(steps):
        if k % 200 == 0:
            simulator.command((0.3 + 0.0005 * k, 0.1, 0), (0, 0, 0.8 - 0.001 * k))
        simulator.step()
        if state.step == ticks.next(state.step):
            twin.update(state.t, *(state.position(encoder.joint) for encoder in twin.encoders))
        found = state.odometer.read()
        assert found.pose == pytest.approx((twin.x, twin.y, twin.heading), abs=1e-12)
        assert found.moved == pytest.approx(twin.moved, abs=1e-12)
        assert found.distance == pytest.approx(twin.distance, abs=1e-12)
        assert (found.step * simulator.dt, found.steps * simulator.dt) == pytest.approx((twin.t, twin.period), abs=1e-9)
    assert abs(twin.heading) > 0.1


@pytest.mark.parametrize("name", ROBOTS)
def test_the_engine_integrates_as_python_does(make: Make, name: str) -> None:
    generation, parameters = ROBOTS[name]
    simulator = make(generation, parameters)
    _agree(simulator, 700)
    simulator.reset()
    assert next(iter(simulator.odometry().values()))[0] == (0.0, 0.0, 0.0)
    _agree(simulator, 300)


def test_the_engine_integrates_mecanum_wheels_and_bicycles(make: Make) -> None:
    _agree(make(None, extra=MECANUM), 500)
    _agree(InSimRun(COMMANDS["car"]).simulator, 1000)


def test_odometry_goes_on_when_the_world_changes(make: Make) -> None:
    simulator = make("ros1", ENCODER)
    simulator.command((0.3, 0, 0), (0, 0, 0.5))
    simulator.run(0.5)
    simulator.world.spawn("unit_box", (3.0, 0.0, 0.5))
    other = make("ros1", ENCODER)
    other.command((0.3, 0, 0), (0, 0, 0.5))
    simulator.run(1.0)
    other.run(1.5)
    (one,), (two,) = simulator.odometry().values(), other.odometry().values()
    assert one[0] == pytest.approx(two[0], abs=1e-9)
    assert one[0][0] > 0.2


@pytest.mark.parametrize("generation", ["ros1", "gz"])
def test_messages_do_not_depend_on_subscribers(make: Make, generation: str) -> None:
    alone, watched = (make(generation, ENCODER if generation == "ros1" else "") for _ in range(2))
    topic = next(each.name for each in watched.bus.topics if each.type == ODOMETRY)
    heard: list[Any] = []
    watched.subscribe(topic, ODOMETRY, heard.append)
    for simulator in (alone, watched):
        simulator.command((0.3, 0, 0), (0, 0, 0.5))
        simulator.run(0.777)
    one, two = alone.bus.latest(topic), heard[-1]
    assert one.header.stamp == two.header.stamp
    assert one.pose.pose == two.pose.pose
    assert one.twist.twist == two.twist.twist
    counts = [next(each.count for each in simulator.bus.topics if each.name == topic) for simulator in (alone, watched)]
    assert counts[0] == counts[1] == len(heard) > 30


def test_a_robot_has_a_second_drive(write_rover: Callable[..., Any]) -> None:
    drive = (
        '<gazebo><plugin name="d{0}" filename="libgazebo_ros_diff_drive.so"><leftJoint>left_joint</leftJoint>'
        "<rightJoint>right_joint</rightJoint><wheelSeparation>0.3</wheelSeparation><wheelDiameter>0.2</wheelDiameter>"
        "<odometrySource>encoder</odometrySource><odometryTopic>odom{0}</odometryTopic>"
        "<odometryFrame>frame{0}</odometryFrame></plugin></gazebo>"
    )
    simulator = Simulator(write_rover(drive.format(1) + drive.format(2)))
    simulator.command((0.3, 0, 0), (0, 0, 0.5))
    simulator.run(1.0)
    found = simulator.odometry()
    assert found["frame1"][0] == pytest.approx(found["frame2"][0], abs=1e-12)
    assert found["frame1"][0][0] > 0.1
