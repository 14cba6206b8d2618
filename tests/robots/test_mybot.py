"""Mybot: driven with the arrow keys, one driver per wheel."""

import pytest

from urdfkit.description import load
from urdfkit.messages import FLOAT, from_fields
from urdfkit.resources import find_model
from urdfkit.sim import Simulator
from urdfkit.teleop import ARROWS

SPEED, TURN = 2.0, 2.0  # [m/s], [rad/s]: those of turtle_teleop_key


@pytest.fixture(scope="module")
def robot():
    return load(find_model(["mybot"]).path)


@pytest.fixture(scope="module")
def with_controllers():
    return load(find_model(["mybot"]).path, arguments={"control": "effort"})


def plugins(robot):
    return [plugin.filename for block in robot.gazebo for plugin in block.plugins]


def test_the_drive_knows_its_wheels(robot):
    plugin = next(p for block in robot.gazebo for p in block.plugins)
    text = {child.tag: child.text for child in plugin.element.children}
    left, right = (robot.joint_by_name[text[side]] for side in ("leftJoint", "rightJoint"))
    assert left.origin.xyz[1] > 0 > right.origin.xyz[1]
    assert float(text["wheelSeparation"]) == left.origin.xyz[1] - right.origin.xyz[1] == 0.25
    assert float(text["wheelDiameter"]) == 2 * robot.link_by_name["left_wheel"].collisions[0].geometry.radius
    assert float(text["wheelTorque"]) == left.limit.effort == right.limit.effort
    assert text["robotBaseFrame"] == robot.roots()[0].name == "footprint"


def test_one_driver_per_wheel(robot, with_controllers):
    assert plugins(robot) == ["libgazebo_ros_diff_drive.so"]
    assert robot.transmissions == ()
    assert plugins(with_controllers) == ["libgazebo_ros_control.so"]
    joints = [transmission.joints[0] for transmission in with_controllers.transmissions]
    assert [joint.name for joint in joints] == ["left_wheel_hinge", "right_wheel_hinge"]
    assert {joint.hardware_interfaces for joint in joints} == {("hardware_interface/EffortJointInterface",)}


@pytest.mark.parametrize("key", list(ARROWS))
def test_it_goes_where_the_arrows_say(robot, driven, key):
    run = driven(robot).drive(ARROWS[key][0] * SPEED, ARROWS[key][3] * TURN, seconds=10, ramp=1.0)
    distance, angle = run.off()
    assert distance < 0.02 * SPEED  # the drive looks at commands 100 times a second
    assert angle < 0.01 * TURN
    assert abs(run.pose[3]) < 1e-6
    assert run.pose[4] < 1e-6


def test_a_curve_at_full_speed(robot, driven):
    run = driven(robot).drive(SPEED, TURN, seconds=10, ramp=1.0)
    distance, angle = run.off()
    assert distance < 0.02 * SPEED
    assert angle < 0.01 * TURN


def test_neither_slips_nor_tips_when_it_starts_and_stops_at_once(robot, driven):
    run = driven(robot)
    worst = 0.0
    for v, w in ((2.0, 0.0), (-2.0, 0.0), (0.0, 2.0), (0.0, 0.0)):
        run.simulator.command((v, 0, 0), (0, 0, w))
        for _ in range(200):
            run.simulator.step(10)
            worst = max(worst, run.pose[4])
    distance, angle = run.off(run.odometry)
    assert worst < 1e-6
    assert distance < 2e-3
    assert angle < 2e-3


def test_topics_are_below_its_name(robot, driven):
    run = driven(robot).drive(0.5, 0.0, seconds=0.1)
    assert run.simulator.command_topics == ("/mybot/cmd_vel",)
    assert {"/mybot/odom_diffdrive", "/mybot/joint_states", "/tf"} <= {topic.name for topic in run.simulator.bus.topics}


def test_an_effort_on_each_wheel_accelerates_it(with_controllers):
    """1.5 N·m on each: 2τ/r moves all of it and turns the wheels."""
    simulator = Simulator(with_controllers, note=lambda _: None)
    for side in ("left", "right"):
        topic = f"/mybot/{side}Wheel_effort_controller/command"
        simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": 1.5}))
    simulator.run(2.0)
    mass = sum(link.inertial.mass for link in with_controllers.links if link.inertial is not None)
    radius = 0.1
    spin = with_controllers.link_by_name["left_wheel"].inertial.inertia.iyy
    acceleration = 2 * 1.5 / radius / (mass + 2 * spin / radius**2)
    assert simulator.state.base_velocity[0] == pytest.approx(2.0 * acceleration, rel=2e-3)
    assert simulator.link_poses()[0][0] == pytest.approx(acceleration * 2.0**2 / 2, rel=4e-3)
    assert simulator.command_topics == ()


def test_unequal_efforts_turn_it(with_controllers):
    """The tutorial's: 1.5 on the left wheel, 1.0 on the right one turns it to the right."""
    simulator = Simulator(with_controllers, note=lambda _: None)
    for side, effort in (("left", 1.5), ("right", 1.0)):
        topic = f"/mybot/{side}Wheel_effort_controller/command"
        simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": effort}))
    simulator.run(1.0)
    assert simulator.link_poses()[0][0] > 0.15
    assert simulator.state.base_velocity[5] < -0.5
