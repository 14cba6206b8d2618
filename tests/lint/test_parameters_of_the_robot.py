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
        ("wheel_radius: 0.024\ntracking_wheel_ticks: 8192", []),  # wheels that only measure
        ("track_width: 0.7\ntrack_length: 0.5", []),  # of belts
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
        ("thigh_length: 120.0", []),  # millimetres
        ("thigh_length: 210.0", ["`thigh_length` is 210 m, but joint `left_shank_joint` is 0.12 m from the origin of"]),
        ("legs: [left, right]\nleg_y: [-0.05, 0.05]", ["`leg_y` is -0.05 m for `left`, which is at y = 0.05 m"]),
        ("legs: [left, right]\nleg_y: [0.04, -0.06]", []),  # both are unknown places
        ("gripper_length: 0.3", []),
        ("wheels: [front_left, front_right]\nspeeds: [0.1, 0.1]", []),
    ],
)
def test_lengths_and_places(tmp_path, parameters, expected):
    messages = found(tmp_path, parameters)
    assert len(messages) == len(expected)
    assert all(map(str.startswith, messages, expected))


def test_parameters_of_the_variants_of_a_robot(tmp_path):
    small = {"config/small.yaml": "walker:\n  ros__parameters:\n    wheel_radius: 0.05\n    track_width: 0.3\n"}
    assert found(tmp_path, "wheel_radius: 0.09\ntrack_width: 0.7", **small) == []
    assert len(found(tmp_path, "wheel_radius: 0.09\ntrack_width: 0.7\nspeed: 1.0", **small)) == 2


@pytest.mark.parametrize(
    ("origin", "name", "length", "is_found"),
    [
        ("0 0.03 -0.16", "shank_length", 0.17, False),  # to the ground, below a foot with a radius of 0.01 m
        ("0 0.03 -0.16", "shank_length", 0.16, False),  # in the plane of the leg
        ("0.04 0.03 -0.16", "shank_length", 0.1649, False),  # in a plane
        ("0.04 0.03 -0.16", "shank_length", 0.19, True),
    ],
)
@pytest.mark.parametrize("bracket", ["0 0 -0.01", "0 0 -0.3"])
def test_ends_of_a_segment(tmp_path, origin, name, length, is_found, bracket):
    foot = '<link name="foot"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>'
    joints = "".join(
        f'<joint name="{side}_{child}_joint" type="{kind}"><parent link="{side}_shank"/><child link="{side}_{child}"/>'
        f'<origin xyz="{place}"/><axis xyz="0 1 0"/><limit effort="1" velocity="1" lower="-1" upper="1"/></joint>'
        for side in ("left", "right")
        for child, kind, place in (("foot", "revolute", origin), ("bracket", "fixed", bracket))
    )
    links = "".join(
        foot.replace("foot", f"{side}_{child}") for side in ("left", "right") for child in ("foot", "bracket")
    )
    robot = FILES["walker.urdf"].replace("</robot>", f"{links}{joints}</robot>")
    assert bool(found(tmp_path, f"{name}: {length}", **{"walker.urdf": robot})) is is_found


ORDER = ("fl_hip", "fl_knee", "fr_hip", "fr_knee")
BY_KIND = ("fl_hip", "fr_hip", "fl_knee", "fr_knee")


@pytest.mark.parametrize(
    ("sent", "others", "expected"),
    [
        ({"order": BY_KIND}, {}, ["joint 2 of controller `legs`, which takes commands by index, is `fl_knee`"]),
        ({"policy_order": BY_KIND, "robot_order": ORDER}, {}, []),  # the node knows both
        ({"joints": BY_KIND}, {"trajectory": BY_KIND}, []),  # of another controller
    ],
)
def test_orders_of_nodes_and_controllers(tmp_path, sent, others, expected):
    controllers = {"legs": ("forward_command_controller/ForwardCommandController", ORDER)} | {
        name: ("joint_trajectory_controller/JointTrajectoryController", joints) for name, joints in others.items()
    }
    text = "".join(
        f"{name}:\n  ros__parameters:\n    type: {kind}\n    joints: [{', '.join(joints)}]\n"
        for name, (kind, joints) in controllers.items()
    )
    lists = "\n".join(f"{key}: [{', '.join(joints)}]" for key, joints in sent.items())
    messages = found(tmp_path, lists, **{"config/controllers.yaml": text})
    assert len(messages) == len(expected)
    assert all(map(str.startswith, messages, expected))


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
