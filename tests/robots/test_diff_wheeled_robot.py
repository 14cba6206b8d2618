"""The differential drive robot of Mastering ROS: driven by keys, within its acceleration, with and without laser."""

import math

import pytest

from urdfkit.description import load
from urdfkit.resources import find_model
from urdfkit.teleop import MOVES

NAMES = ("diff_wheeled_robot", "diff_wheeled_robot_with_laser")
SPEED, TURN = 0.5, 1.0  # [m/s], [rad/s]: those of teleop_twist_keyboard


@pytest.fixture(scope="module", params=NAMES)
def robot(request):
    return load(find_model([request.param]).path)


def drive_of(robot):
    plugin = next(p for block in robot.gazebo for p in block.plugins)
    assert plugin.filename == "libgazebo_ros_diff_drive.so"
    return {child.tag: child.text for child in plugin.element.children}


def test_the_drive_knows_its_wheels(robot):
    text = drive_of(robot)
    left, right = (robot.joint_by_name[text[side]] for side in ("leftJoint", "rightJoint"))
    assert left.origin.xyz[1] > 0 > right.origin.xyz[1]
    assert float(text["wheelSeparation"]) == left.origin.xyz[1] - right.origin.xyz[1] == 0.3
    assert float(text["wheelDiameter"]) == 2 * robot.link_by_name[left.child].collisions[0].geometry.radius
    assert float(text["wheelTorque"]) == left.limit.effort == right.limit.effort
    assert float(text["wheelAcceleration"]) == 1.8
    assert text["robotBaseFrame"] == robot.roots()[0].name


def texts(element):
    yield element.tag, element.text
    for child in element.children:
        yield from texts(child)


def test_casters_touch_the_ground(robot):
    axle = robot.joint_by_name["base_footprint_joint"].origin.xyz[2]
    for end in ("front", "back"):
        joint = robot.joint_by_name[f"caster_{end}_link_joint"]
        radius = robot.link_by_name[joint.child].collisions[0].geometry.radius
        assert axle + joint.origin.xyz[2] == pytest.approx(radius, abs=1e-15)


def test_the_laser_is_on_top_and_sees_half_a_turn():
    robot = load(find_model(["diff_wheeled_robot_with_laser"]).path)
    x, y, z = robot.joint_by_name["hokuyo_joint"].origin.xyz
    plate, housing = (robot.link_by_name[name].collisions[0].geometry for name in ("base_link", "hokuyo_link"))
    assert z - housing.size[2] / 2 == pytest.approx(plate.length / 2)
    assert (x + housing.size[0] / 2, y) == (plate.radius, 0)
    (sensor,) = (sensor for block in robot.gazebo for sensor in block.sensors)
    scan = dict(texts(sensor.element))
    assert (int(scan["samples"]), float(scan["update_rate"])) == (720, 40)
    assert float(scan["max_angle"]) == -float(scan["min_angle"]) == math.pi / 2
    assert scan["topicName"] == "/scan"


@pytest.mark.parametrize("key", ["i", "u", "o", "j", "l", ",", "m", "."])
def test_it_goes_where_the_keys_say(robot, driven, key):
    v, w = MOVES[key][0] * SPEED, MOVES[key][3] * TURN
    run = driven(robot).drive(v, w, seconds=10, ramp=0.5)
    distance, angle = run.off()
    assert distance < 0.02 * SPEED  # the drive looks at commands 100 times a second
    assert angle < 0.01 * TURN
    assert abs(run.pose[3]) < 1e-6
    assert run.pose[4] < 1e-6


def test_its_acceleration_is_limited(robot, driven):
    run = driven(robot)
    speeds = []
    run.simulator.command((0.9, 0, 0), (0, 0, 0))
    for _ in range(100):
        run.simulator.step(10)
        speeds.append(run.simulator.state.base_velocity[0])
    assert max(after - before for before, after in zip([0.0, *speeds], speeds, strict=False)) < 1.8 * 0.01 + 1e-6
    assert speeds[24] == pytest.approx(1.8 * 0.25, abs=1.8 * 0.01)
    assert speeds[-1] == pytest.approx(0.9, abs=1e-6)


def test_neither_slips_nor_rocks(robot, driven):
    run = driven(robot)
    worst = 0.0
    for v, w in ((0.5, 0.0), (-0.5, 0.0), (0.5, 1.0), (0.0, 0.0)):
        run.simulator.command((v, 0, 0), (0, 0, w))
        for _ in range(100):
            run.simulator.step(10)
            worst = max(worst, run.pose[4])
    distance, angle = run.off(run.odometry)
    assert worst < 1e-6
    assert distance < 1e-4
    assert angle < 1e-4


def test_topics_have_no_namespace(robot, driven):
    run = driven(robot).drive(0.5, 0.0, seconds=0.1)
    assert run.simulator.command_topics == ("/cmd_vel",)
    assert {"/odom", "/joint_states", "/tf"} <= {topic.name for topic in run.simulator.bus.topics}
