"""The GEM e2: a car that drives on circles of the radius its commands give, in both meanings of angular.z."""

import math

import pytest

from urdfkit.description import load
from urdfkit.resources import find_model
from urdfkit.sim import Simulator

WHEEL_BASE, TRACK = 1.75, 1.2


@pytest.fixture(scope="module", params=["classic", "gz"])
def generation(request):
    return request.param


@pytest.fixture(scope="module")
def robot(generation):
    return load(find_model(["gem_e2"]).path, arguments={"gazebo": generation})


def test_it_is_as_heavy_and_as_large_as_the_car(robot):
    mass = sum(link.inertial.mass for link in robot.links if link.inertial is not None)
    sensors = sum(robot.link_by_name[name].inertial.mass for name in ("camera", "velodyne"))
    assert mass - sensors == pytest.approx(686)
    hinge = robot.joint_by_name["left_steering_hinge_joint"].origin.xyz
    assert hinge == (WHEEL_BASE, TRACK / 2, 0)
    assert robot.joint_by_name["rear_right_wheel_joint"].origin.xyz == (0, -TRACK / 2, 0)


def test_the_lidar_can_be_left_out(generation):
    robot = load(find_model(["gem_e2"]).path, arguments={"gazebo": generation, "velodyne": "false"})
    assert "velodyne" not in robot.link_by_name
    assert [sensor.name for block in robot.gazebo for sensor in block.sensors] == ["camera1"]


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "steer"), [(2.0, 0.2), (2.0, -0.4), (-1.5, 0.3), (5.0, 0.05), (3.0, 0.0)])
def test_it_goes_in_circles(robot, generation, speed, steer):
    """In Gazebo Classic angular.z is the steering angle, in gz sim the yaw rate."""
    simulator = Simulator(robot, note=lambda _: None)
    classic = generation == "classic"
    # The one of Gazebo Classic steers to the other side when it backs up, and holds the speed of the right rear wheel.
    bend = math.tan(math.copysign(steer, speed * steer) if classic else steer) / WHEEL_BASE
    real = speed / (1 + bend * TRACK / 2) if classic else speed
    turn = real * bend
    simulator.command((speed, 0, 0), (0, 0, steer if classic else turn))
    simulator.run(6.0)
    at = simulator.link_poses()[0].copy()
    seconds = 4.0
    simulator.run(seconds)
    now = simulator.link_poses()[0]
    turned = math.remainder(2 * (math.atan2(now[5], now[6]) - math.atan2(at[5], at[6])), 2 * math.pi)
    assert turned == pytest.approx(turn * seconds, rel=0.01, abs=1e-3)
    chord = math.hypot(now[0] - at[0], now[1] - at[1])
    ideal = abs(real) * seconds
    if turn:
        ideal = 2 * abs(real / turn) * abs(math.sin(turn * seconds / 2))
    assert chord == pytest.approx(ideal, rel=0.01)
    assert math.hypot(now[3], now[4]) < 1e-3  # upright
    assert abs(now[2]) < 1e-3


def test_the_inner_wheel_turns_further(robot):
    simulator = Simulator(robot, note=lambda _: None)
    simulator.command((2.0, 0, 0), (0, 0, 0.3))
    simulator.run(5.0)
    left, right = (simulator.state.position(f"{side}_steering_hinge_joint") for side in ("left", "right"))
    assert 1 / math.tan(right) - 1 / math.tan(left) == pytest.approx(TRACK / WHEEL_BASE, rel=0.02)


def test_its_topics(robot):
    simulator = Simulator(robot, note=lambda _: None)
    assert simulator.command_topics == ("/twist_to_ackermann",)
    assert "/odom" in {topic.name for topic in simulator.bus.topics}
