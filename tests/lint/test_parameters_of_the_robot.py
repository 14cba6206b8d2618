"""Parameters of nodes that describe the robot: correct values next to wrong ones."""

from pathlib import Path

import pytest

from tests.lint.test_build_files import write
from urdfkit.lint import lint

HERE = Path(__file__).parent / "rules" / "parameter-contradicts-robot"
FILES = {name: (HERE / name).read_text() for name in ("package.xml", "walker.urdf")}
LIMBS = ("front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel")


def found(folder, parameters, **files):
    text = "".join(f"    {line}\n" for line in parameters.splitlines())
    write(folder, {**FILES, "config/walker.yaml": f"walker:\n  ros__parameters:\n{text}", **files})
    return [finding.message for finding in lint(folder / "walker.urdf") if finding.code == "K993"]


@pytest.mark.parametrize(
    ("parameters", "expected"),
    [
        ("track_width: 0.5", []),  # the effective track of four wheels that slip
        ("track_width: 0.7", ["`track_width` is 0.7 m, but the wheels are 0.3 m apart"]),
        ("wheel_base: 0.3", []),  # in some packages the distance of the left and the right wheel
        ("wheel_radius: 0.0", []),
        ("wheel_radius: 50.0", []),  # millimetres
        ("wheel_diameter: 3.94", []),  # inches
        ("track_width: 300.0", []),
        ("wheel_radius: $(arg radius)", []),
        ("drive_wheel_radius: 0.5", ["`drive_wheel_radius` is 0.5 m, but the radius of the wheels is 0.05 m"]),
        ("left_thigh_length: 0.3", []),
        ("shank_length: 0.3", []),  # nothing is fixed to the end of the shank
        ("thigh_length: 0.05", []),  # of its box
        ("thigh_length: 0.1215", []),
        ("legs: [left, right]\nleg_y: [-0.05, 0.05]", ["`leg_y` is -0.05 m for `left`, which is at y = 0.05 m"]),
        ("legs: [left, right]\nleg_y: [0.04, -0.06]", []),  # both are unknown places
        ("gripper_length: 0.3", []),
        ("wheels: [front_left, front_right]\nspeeds: [0.1, 0.1]", []),
    ],
)
def test_lengths_and_places(tmp_path, parameters, expected):
    assert found(tmp_path, parameters) == expected


def test_wheels_beside_those_of_another_robot(tmp_path):
    other = '<robot name="o"><joint name="j" type="continuous"/></robot>'
    assert found(tmp_path, "wheel_radius: 0.1", **{"other.urdf": other}) == []


@pytest.mark.parametrize(
    ("limbs", "expected"),
    [
        (("fl_hip", "fl_knee", "fr_hip", "fr_knee", "rl_hip", "rl_knee"), []),
        (("fl_hip", "fl_knee", "fr_knee", "fr_hip", "rl_hip", "rl_knee"), ["`fr_knee`"]),
        (("fl_hip", "fl_knee", "fr_knee", "fr_hip", "rl_knee", "rl_hip"), ["`fl_hip`"]),
        (("fl_hip", "fl_knee", "fr_hip", "fr_knee", "rl_hip", "rl_foot"), []),
        (("fl_hip", "fl_knee", "fr_knee", "fr_hip"), []),
        (LIMBS, []),
    ],
)
@pytest.mark.parametrize("kind", ["forward_command_controller/ForwardCommandController", "a/JointTrajectoryController"])
def test_orders_of_limbs(tmp_path, limbs, expected, kind):
    text = f"type: {kind}\njoints: [{', '.join(limbs)}]"
    shown = [message.partition(" ")[0] for message in found(tmp_path, text)]
    assert shown == (expected if "Forward" in kind else [])
