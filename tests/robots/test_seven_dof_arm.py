"""The arm of Mastering ROS: seven joints, a gripper, gains from YAML, with and without a depth camera."""

import math

import numpy as np
import pinocchio
import pytest
import yaml

from urdfkit.description import load
from urdfkit.kinematics import Kinematics
from urdfkit.messages import FLOAT, JOINT_STATE, from_fields
from urdfkit.resources import find_model, robots_dir
from urdfkit.sim import Simulator

NAMES = ("seven_dof_arm", "seven_dof_arm_with_rgbd")
JOINTS = (
    "shoulder_pan_joint",
    "shoulder_pitch_joint",
    "elbow_roll_joint",
    "elbow_pitch_joint",
    "wrist_roll_joint",
    "wrist_pitch_joint",
    "gripper_roll_joint",
)
FINGERS = ("finger_joint1", "finger_joint2")


@pytest.fixture(scope="module", params=NAMES)
def robot(request):
    return load(find_model([request.param]).path)


@pytest.fixture(scope="module")
def settings():
    path = robots_dir() / "seven_dof_arm/seven_dof_arm_control/config/seven_dof_arm_control.yaml"
    return yaml.safe_load(path.read_text())["seven_dof_arm"]


def place(robot, link, **joints):
    kinematics = Kinematics(robot)
    return dict(zip(kinematics.link_names, kinematics.link_poses(kinematics.configuration(joints)), strict=True))[link]


def test_joints(robot):
    assert tuple(j.name for j in robot.joints if j.type == "revolute") == JOINTS
    assert tuple(j.name for j in robot.joints if j.type == "prismatic") == FINGERS


def test_it_points_straight_up_and_bends_forward(robot):
    np.testing.assert_allclose(place(robot, "grasping_frame")[:3], [0, 0, 0.84], atol=1e-12)
    bent = place(robot, "grasping_frame", elbow_pitch_joint=1.0)
    below, above = 0.02 + 0.1 + 0.08 + 0.14 + 0.06, 0.22 + 0.06 + 0.06 + 0.02 + 0.08
    np.testing.assert_allclose(bent[:3], [above * math.sin(1.0), 0, below + above * math.cos(1.0)], atol=1e-12)


def test_the_fingers_close_to_the_middle(robot):
    gap = []
    for closed in (0.0, 1.0):
        limits = [robot.joint_by_name[name].limit for name in FINGERS]
        at = dict(zip(FINGERS, (closed * limits[0].upper, closed * limits[1].lower), strict=True))
        right, left = (place(robot, f"gripper_finger_link{n}", **at) for n in (1, 2))
        assert right[1] == pytest.approx(-left[1], abs=1e-12)
        gap.append(left[1] - right[1] - robot.link_by_name["gripper_finger_link1"].collisions[0].geometry.size[1])
    np.testing.assert_allclose(gap, [0.05, 0.0], atol=1e-12)


def test_a_controller_for_every_joint(robot, settings):
    assert settings["joint_state_controller"]["publish_rate"] == 50
    positions = [s for s in settings.values() if s.get("type") == "position_controllers/JointPositionController"]
    assert tuple(s["joint"] for s in positions) == JOINTS + FINGERS
    gains = settings["gazebo_ros_control"]["pid_gains"]
    assert tuple(gains) == JOINTS + FINGERS
    for number, joint in enumerate(JOINTS, 1):
        controller = settings[f"joint{number}_position_controller"]
        assert controller["joint"] == joint
        assert controller["pid"] == gains[joint] == {"p": 100.0, "i": 0.0, "d": 10.0}
    transmissions = {t.joints[0].name: t.joints[0].hardware_interfaces for t in robot.transmissions}
    assert transmissions == dict.fromkeys(JOINTS + FINGERS, ("hardware_interface/PositionJointInterface",))


def test_the_camera_looks_where_the_gripper_points():
    robot = load(find_model(["seven_dof_arm_with_rgbd"]).path)
    for joints in ({}, {"wrist_pitch_joint": 0.7, "gripper_roll_joint": 1.0}):
        x, y, z, w = place(robot, "rgbd_camera_optical_frame", **joints)[3:]
        forward = [2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)]
        angle = joints.get("wrist_pitch_joint", 0.0)
        np.testing.assert_allclose(forward, [math.sin(angle), 0, math.cos(angle)], atol=1e-12)


def test_the_camera_publishes_every_picture_once():
    robot = load(find_model(["seven_dof_arm_with_rgbd"]).path)
    topics = []
    for block in robot.gazebo:
        for sensor in block.sensors:
            text = {child.tag: child.text for child in sensor.plugins[0].element.children}
            topics += [f"/{text['cameraName']}/{text[tag]}" for tag in text if tag.endswith("TopicName")]
    assert len(topics) == len(set(topics))
    assert {
        "/rgbd_camera/rgb/image_raw",
        "/rgbd_camera/ir/image_raw",
        "/rgbd_camera/depth/image_raw",
        "/rgbd_camera/depth/points",
    } <= set(topics)


def command(simulator, controller, position):
    topic = f"/seven_dof_arm/{controller}_position_controller/command"
    simulator.bus.publish(topic, FLOAT, from_fields(FLOAT, {"data": position}))


def sag(robot, simulator):
    """Return how far gravity and dry friction may push each joint from its target with P = 100 N·m/rad [rad]."""
    kinematics = Kinematics(robot)
    q = kinematics.configuration({name: simulator.state.position(name) for name in (*JOINTS, *FINGERS)})
    pull = pinocchio.computeGeneralizedGravity(kinematics.model, kinematics.model.createData(), q)
    return {name: pull[kinematics.velocity_index(name)] / 100.0 for name in JOINTS}


def test_joint_4_goes_to_one_radian(robot):
    """As in the book; every joint ends where P times its error is what gravity pulls, give or take dry friction."""
    simulator = Simulator(robot, note=lambda _: None)
    command(simulator, "joint4", 1.0)
    simulator.run(5.0)
    pulled = sag(robot, simulator)
    for name in JOINTS:
        wanted = 1.0 if name == "elbow_pitch_joint" else 0.0
        error = wanted - simulator.state.position(name)
        assert abs(error - pulled[name]) < 1.1e-3, name  # 0.1 N·m of dry friction, and a little creep
    assert simulator.state.position("elbow_pitch_joint") == pytest.approx(1.0, abs=0.03)


def test_the_gripper_closes(robot):
    simulator = Simulator(robot, note=lambda _: None)
    command(simulator, "finger1", 0.02)
    command(simulator, "finger2", -0.02)
    simulator.run(2.0)
    assert simulator.state.position("finger_joint1") == pytest.approx(0.02, abs=2e-4)
    assert simulator.state.position("finger_joint2") == pytest.approx(-0.02, abs=2e-4)


def test_joint_states_come_50_times_a_second(robot):
    simulator = Simulator(robot, note=lambda _: None)
    stamps = []
    simulator.subscribe("/seven_dof_arm/joint_states", JOINT_STATE, lambda m: stamps.append(len(m.name)))
    simulator.run(2.0)
    assert stamps == [9] * 100
