"""Arms and grippers of new robots: clear of themselves, held, moved where they are told, and nothing tips over."""

import itertools
import math
import re
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, reject, settings
from hypothesis import strategies as st

from urdfkit.description import load
from urdfkit.errors import UsageError
from urdfkit.kinematics import Kinematics
from urdfkit.lint import lint
from urdfkit.resources import find_model
from urdfkit.scaffold import create
from urdfkit.sim import Simulator

FINGERS = ("left_finger_joint", "right_finger_joint")


@pytest.fixture
def made(robot_template, tmp_path):
    """Return what writes a robot and loads it."""

    def make(**given):
        answers = robot_template.answers({"name": "scout", **given}) | {"year": "2026", "into": "."}
        create(robot_template, answers, tmp_path)
        return load(find_model([f"{tmp_path}/scout_description"]).path)

    return make


def simulated(robot):
    return Simulator(robot, note=lambda _: None)


def positions(simulator, joints):
    return [simulator.state.position(joint) for joint in joints]


@pytest.mark.parametrize(
    ("arm", "ros"), [("3", "jazzy"), ("4", "noetic"), ("5", "none"), ("6", "humble"), ("7", "noetic"), ("7", "jazzy")]
)
def test_goes_where_it_is_told_and_the_gripper_opens_and_closes(made, arm_joints, tell, arm, ros):
    simulator = simulated(made(arm=arm, ros=ros, drive="none", gripper="yes"))
    joints = arm_joints[arm]
    targets = dict(zip(joints, itertools.cycle((0.7, -0.5, 0.9, 0.4, -0.6)), strict=False))
    both = FINGERS if ros == "noetic" else FINGERS[:1]
    tell(simulator, ros, targets, 2)
    tell(simulator, ros, dict.fromkeys(both, 0.01), 1)
    simulator.run(3.5)
    assert positions(simulator, joints) == pytest.approx(list(targets.values()), abs=1e-2)
    assert positions(simulator, FINGERS) == pytest.approx([0.01, 0.01], abs=2e-4)
    tell(simulator, ros, dict.fromkeys(both, 0.0), 1)
    simulator.run(2.0)
    assert positions(simulator, FINGERS) == pytest.approx([0, 0], abs=2e-4)
    assert abs(simulator.link_poses()[0, :3]).max() < 1e-12  # bolted down


@pytest.mark.parametrize("arm", ["3", "4", "5", "6", "7"])
def test_points_straight_up_at_zero_and_reaches_as_far_as_it_says(made, arm_joints, arm):
    robot = made(arm=arm, ros="none", arm_reach="0.4")
    kinematics = Kinematics(robot)

    def place(link, **joints):
        poses = kinematics.link_poses(kinematics.configuration(joints))
        return dict(zip(kinematics.link_names, poses, strict=True))[link][:3]

    shoulder = place("upper_arm_link")
    np.testing.assert_allclose(place("tool0") - shoulder, [0, 0, 0.4], atol=1e-12)
    forward = place("tool0", shoulder_lift_joint=math.pi / 2)
    np.testing.assert_allclose(forward - shoulder, [0.4, 0, 0], atol=1e-12)
    masses = [link.inertial.mass for link in robot.links if link.inertial]
    arm_links = ("arm_foot", "shoulder", "upper_arm", "forearm", "hand")
    own = sum(link.inertial.mass for link in robot.links if link.inertial and link.name.startswith(arm_links))
    assert own == pytest.approx(1.25)
    assert sum(masses) > own
    assert [j.name for j in robot.joints if j.type == "revolute"] == arm_joints[arm]


@pytest.mark.parametrize("ros", ["jazzy", "noetic", "none"])
def test_holds_still_where_it_starts(made, arm_joints, ros):
    simulator = simulated(made(arm="6", ros=ros, gripper="yes"))
    before = positions(simulator, arm_joints["6"])
    simulator.run(1.0)
    assert positions(simulator, arm_joints["6"]) == pytest.approx(before, abs=1e-2)
    assert abs(simulator.link_poses()[0, :3]).max() < 1e-3


@pytest.mark.parametrize("drive", ["diff", "skid", "ackermann", "omni"])
def test_stretched_out_to_any_side_it_tips_nothing_over(made, tell, drive):
    """With the heaviest arm that is accepted; a payload weighs as much less."""
    simulator = simulated(made(drive=drive, arm="5", arm_reach="0.39", arm_mass="1.9", payload="0.001"))
    tilt = 0.0
    for pan in (-3.0, -2.0, -1.0, 0.0, 1.0, 2.0, 3.0):
        targets = {"shoulder_lift_joint": 1.57, "elbow_joint": 0, "wrist_pitch_joint": 0, "shoulder_pan_joint": pan}
        tell(simulator, "jazzy", targets, 2)
        simulator.run(2.5)
        tilt = max(tilt, math.hypot(*simulator.link_poses()[0, 3:5]))
    assert tilt < 2e-3


@pytest.mark.slow
@settings(max_examples=6, deadline=None, suppress_health_check=list(HealthCheck))
@given(
    drive=st.sampled_from(["diff", "skid", "ackermann", "omni"]),
    arm=st.sampled_from(["3", "4", "5", "6", "7"]),
    size=st.tuples(st.floats(0.25, 1.2), st.floats(0.2, 0.8), st.floats(0.05, 0.3), st.floats(0.04, 0.15)),
    mass=st.floats(2, 60),
    share=st.floats(0.5, 1.5),
)
def test_every_size_that_is_accepted_stands_stretched_out(robot_template, tell, drive, arm, size, mass, share):
    names = ("base_length", "base_width", "base_height", "wheel_radius")
    answers = dict(zip(names, map("{:.3f}".format, size), strict=True)) | {"mass": f"{mass:.2f}", "drive": drive}
    answers |= {"name": "scout", "arm": arm, "arm_reach": f"{share * size[0]:.3f}"}
    try:
        answers = robot_template.answers(answers)
    except UsageError:
        reject()
    with tempfile.TemporaryDirectory() as folder:
        create(robot_template, answers | {"year": "2026", "into": "."}, Path(folder))
        assert [str(finding) for finding in lint([folder], package_path=[folder])] == []
        simulator = simulated(load(find_model([f"{folder}/scout_description"]).path))
    for pan in (0.0, 1.6, 2.8):
        joints = {"shoulder_pan_joint": pan, "shoulder_lift_joint": 1.57, "elbow_joint": 0.0}
        tell(simulator, "jazzy", joints | ({} if arm == "3" else {"wrist_pitch_joint": 0.0}), 2)
        simulator.run(2.5)
        assert math.hypot(*simulator.link_poses()[0, 3:5]) < 2e-3
        assert simulator.state.position("shoulder_lift_joint") == pytest.approx(1.57, abs=1e-2)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"arm": "2"}, "--arm `2` is not available; choose from: none, 3, 4, 5, 6, 7"),
        ({"gripper": "yes"}, "--gripper requires --arm 3 or 4 or 5 or 6 or 7"),
        ({"arm_reach": "1"}, "--arm-reach requires --arm 3 or"),
        ({"arm": "6", "finger_travel": "0.02"}, "--finger-travel requires --gripper yes"),
        ({"arm": "6", "arm_reach": "1"}, "tip over with the arm stretched out"),
        ({"arm": "6", "arm_mass": "3"}, "tip over with the arm stretched out"),
        ({"arm": "6", "payload": "2"}, "tip over with the arm stretched out"),
        ({"arm": "6", "drive": "none", "arm_reach": "4", "arm_mass": "60"}, "foot of the arm would not fit"),
        ({"arm": "6", "drive": "none", "arm_mass": "20"}, "denser than any material"),
        ({"arm": "6", "drive": "none", "arm_mass": "0.001"}, "lighter than any material"),
        ({"arm": "6", "drive": "none", "gripper": "yes", "finger_travel": "0.1"}, "would use most of the payload"),
    ],
)
def test_refuses_what_would_not_work(robot_template, given, message):
    with pytest.raises(UsageError, match=message):
        robot_template.answers({"name": "scout", **given})


@pytest.mark.parametrize("gripper", ["yes", "no"])
def test_without_ros_the_readme_says_what_moves_it(robot_template, tmp_path, gripper):
    """Every topic of the table is heard, and every joint has one."""
    given = {"name": "scout", "ros": "none", "arm": "5", "gripper": gripper}
    create(robot_template, robot_template.answers(given) | {"year": "2026", "into": "."}, tmp_path)
    text = (tmp_path / "scout_description/README.md").read_text()
    told = re.findall(r"^\| `(/.*?)`", text, re.MULTILINE)
    joints = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_pitch", "wrist_roll"]
    assert told == [*(f"/arm/{joint}" for joint in joints), *(["/gripper"] if gripper == "yes" else [])]
    simulator = Simulator(load(tmp_path / "scout_description/urdf/scout.urdf.xacro"), note=lambda _: None)
    assert set(told) <= {topic.name for topic in simulator.bus.topics if topic.subscribers}
