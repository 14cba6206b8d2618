"""The heterogeneous robot: a platform that goes in any direction, and an arm that stays where it is told."""

import math

import numpy as np
import pytest

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.messages import TRAJECTORY, from_fields
from urdfkit.resources import find_model
from urdfkit.sim import Simulator
from urdfkit.teleop import MOVES

SPEED, TURN = 0.5, 1.0  # [m/s], [rad/s]: those of teleop_twist_keyboard
ARM = tuple(f"jarmLink{i}" for i in range(6))


@pytest.fixture(scope="module")
def robot():
    return load(find_model(["heterogeneous"]).path)


def test_lenses_and_lidars(robot):
    kinematics = Kinematics(robot)
    at = dict(zip(kinematics.link_names, kinematics.link_poses(kinematics.neutral()), strict=True))
    np.testing.assert_allclose(at["camera_depth_frame"][:3] - at["camera_rgb_frame"][:3], [0, 0.03, 0], atol=1e-12)
    for lens in ("rgb", "depth"):
        np.testing.assert_allclose(at[f"camera_{lens}_optical_frame"][3:], [-0.5, 0.5, -0.5, 0.5], atol=1e-12)
    np.testing.assert_allclose(np.abs(at["laser2"][3:]), [0, 0, 1, 0], atol=1e-12)
    assert at["laser1"][0] > 0 > at["laser2"][0]


def test_lidars_see_past_arm_and_platform(robot):
    """No beam, within the platform, comes near the arm's base."""
    radius = robot.link_by_name["armBase"].collisions[0].geometry.radius
    sensors = [sensor for block in robot.gazebo for sensor in block.sensors if sensor.type == "ray"]
    assert [sensor.name for sensor in sensors] == ["halfradius", "fullradius"]
    assert 0.1 * math.sin(1.770796) > radius


def test_the_wheels_carry_it(robot):
    simulator = Simulator(robot, note=lambda _: None)
    simulator.run(0.5)
    assert abs(simulator.link_poses()[0][2]) < 1e-4


@pytest.mark.parametrize("key", ["i", ",", "j", "l", "u", "J", "L", "U", "O", "<", "M"])
def test_it_goes_where_the_keys_say(robot, driven, key):
    x, y, _, turn = MOVES[key]
    run = driven(robot).drive(x * SPEED, turn * TURN, vy=y * SPEED, seconds=5)
    distance, angle = run.off()
    assert distance < 0.002
    assert angle < 0.004
    assert abs(run.pose[3]) < 1e-3


def test_it_turns_and_goes_sideways_at_once(robot, driven):
    run = driven(robot).drive(0.3, 0.8, vy=-0.4, seconds=10)
    distance, angle = run.off()
    assert distance < 0.005
    assert angle < 0.01


def test_topics_have_no_namespace(robot, driven):
    run = driven(robot).drive(0.5, 0.0, seconds=0.1)
    assert run.simulator.command_topics == ("/cmd_vel",)
    assert {"/odom", "/tf", "/heterogeneous/joint_states"} <= {topic.name for topic in run.simulator.bus.topics}


def test_the_arm_follows_a_trajectory_while_it_drives(robot):
    simulator = Simulator(robot, note=lambda _: None)
    goal = [0.5, 0.6, 0.7, -0.4, 0.8, 1.0]
    fields = {"joint_names": list(ARM), "points": [{"positions": goal, "time_from_start": {"sec": 3, "nanosec": 0}}]}
    simulator.bus.publish("/heterogeneous/arm_controller/command", TRAJECTORY, from_fields(TRAJECTORY, fields))
    simulator.command((0.3, 0.2, 0), (0, 0, 0.3))
    simulator.run(8.0)
    for name, wanted in zip(ARM, goal, strict=True):
        assert simulator.state.position(name) == pytest.approx(wanted, abs=5e-3), name
