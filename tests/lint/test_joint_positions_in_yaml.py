"""Positions of joints in degrees or millimetres, in the parameters of a robot's own nodes."""

from __future__ import annotations

from pathlib import Path

import pytest

from urdfkit.lint import lint

LIMIT = '<limit lower="{}" upper="{}" effort="1" velocity="1"/>'
JOINT = '<link name="l{0}"/><joint name="j{0}" type="{1}"><parent link="{2}"/><child link="l{0}"/>{3}</joint>'
ROBOT = (
    '<robot name="arm"><link name="base"/>'
    + JOINT.format(1, "revolute", "base", LIMIT.format(-2.8, 2.8))
    + JOINT.format(2, "revolute", "l1", LIMIT.format(-1.6, 1.6))
    + JOINT.format(3, "revolute", "l2", LIMIT.format(-2.2, 2.2))
    + JOINT.format("_jaw", "prismatic", "l3", LIMIT.format(0, 0.03))
    + "</robot>"
)
LISTED = "arm:\n  ros__parameters:\n    joints: [j1, j2, j3]\n    home: {}\n"
DEGREES = "`{}` has 45 for joint `j2`, whose limits are -1.6 to 1.6; write radians, if the values are degrees"
MILLIMETRES = "`open_position` has 25 for joint `j_jaw`, whose limits are 0 to 0.03; write metres, if the values are "
CASES = [
    (LISTED.format("[0, 45, -90]"), DEGREES.format("home")),
    (LISTED.format("[0.0, 0.8, -1.6]") + "    ready_pose: [2, 45, -90]\n", DEGREES.format("ready_pose")),
    (LISTED.format("[0.0, 0.8, -1.6]") + "mover:\n  start_angles: [2, 45, -90]\n", DEGREES.format("start_angles")),
    ("initial_positions:\n  j1: 0\n  j2: 45\n  j3: -90\n", DEGREES.format("initial_positions")),
    ("joint: j_jaw\nopen_position: 25\n", MILLIMETRES + "millimetres"),
    ("initial_positions:\n  j1: 0\n  j2: 45  # degrees\n  j3: -90\n", ""),
    (LISTED.format("[0.0, 0.8, -1.6]") + "    stiffness: [10, 45, 90]\n", ""),
    (LISTED.format("[0.0, 0.8, -1.6]") + "wheels:\n  pose_covariance_diagonal: [7, 14, 21]\n", ""),
    ("initial_positions:\n  j1: 0.5\n  j2: 1.2\n  j3: -2.0\n", ""),
    ("joint: j_jaw\nopen_position: 0.025\nspeed: 25\n", ""),
]


@pytest.mark.parametrize("converts", [False, True])
@pytest.mark.parametrize(("text", "message"), CASES)
def test_positions_in_other_units_are_found_unless_code_converts_them(tmp_path: Path, text, message, converts):
    findings = findings_of(tmp_path, text, "goal = [math.radians(each) for each in home], width / 1000.0\n" * converts)
    assert findings == ([message] if message and not converts else [])


def findings_of(tmp_path: Path, text: str, code: str = "") -> list[str]:
    """Return the messages about values of a YAML file, next to code."""
    manifest = "<name>arm</name><version>1.0.0</version><buildtool_depend>ament_cmake</buildtool_depend>"
    files = {"package.xml": f'<package format="3">{manifest}</package>', "arm.urdf": ROBOT, "config/arm.yaml": text}
    if code:
        files["arm/mover.py"] = code
    for name, content in files.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(content)
    return [each.message for each in lint(tmp_path) if each.code == "K971"]


GRASPING = "hand:\n  type: position_controllers/GripperActionController\n  joint: j_jaw\n"
GRASPING += "picker:\n  joints: [j1, j2, j3]\n  gripper_action: /hand/gripper_cmd\n  open_width: {}\n"
OTHER_ORDER = "joint 1 of `joints` is `j1`, but `j3 rad` in the comment on line 2"
OTHERS = [
    ("joint: j_jaw\nraised: 0.05\n", "`raised` has 0.05 for joint `j_jaw`, whose limits are 0 to 0.03"),
    ("joint: j_jaw\nraised: 0.03\nlowered: 0.0\n", ""),
    ("joint: j_jaw\nmax_position: 0.05\n", ""),
    ("joint: j1\nhome_position: 3.0\n", "`home_position` has 3 for joint `j1`, whose limits are -2.8 to 2.8"),
    ("joint: j1\nhome_position: 2048\n", ""),
    ("joint: j2\nopen_angle: 150\n", ""),
    ("joint: j_jaw\nraised: 3000\n", ""),
    ("initial_positions:\n  j1: 0.5\n  j2: 45\n", DEGREES.format("initial_positions")),
    ("initial_positions:\n  j1: 0.5\n  j2: 1.605\n", ""),
    (GRASPING.format(25), MILLIMETRES.replace("open_position", "open_width") + "millimetres"),
    (GRASPING.format(0.06), ""),
    ("# j3 rad, j2 rad, j1 rad\n".join(("joints: [j1, j2, j3]\n", "home: [0, 0, 0]\n")), OTHER_ORDER),
    ("# j1 rad, j2 rad, j3 rad\n".join(("joints: [j1, j2, j3]\n", "home: [0, 0, 0]\n")), ""),
    ("# base, arm, wrist\n".join(("joints: [j1, j2, j3]\n", "home: [0, 0, 0]\n")), ""),
]


@pytest.mark.parametrize(("text", "message"), OTHERS)
def test_positions_beyond_limits_and_in_the_order_of_other_joints(tmp_path: Path, text, message):
    assert findings_of(tmp_path, text) == ([message] if message else [])
