"""Every drive, with and without an arm, for both generations: what reads URDF and SDF elsewhere reads it, too."""

import itertools
import re
import shutil
import subprocess

import mujoco
import pinocchio as pin
import pytest

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.resources import find_model
from urdfkit.scaffold import create

DRIVES = ("diff", "skid", "ackermann", "omni", "none")
ROBOTS = [
    {"name": f"{drive}_{arm}_{ros}", "drive": drive, "arm": arm, "ros": ros}
    for drive, arm, ros in itertools.product(DRIVES, ("none", "6"), ("jazzy", "noetic"))
    if (drive, ros) != ("ackermann", "noetic")
]


@pytest.fixture(scope="module")
def expanded(robot_template, tmp_path_factory):
    """Return name → (the xacro, the URDF of it) of each robot, and the folder they are in."""
    folder = tmp_path_factory.mktemp("robots")
    found = {}
    for given in ROBOTS:
        gripper = {"gripper": "yes"} if given["arm"] != "none" else {}
        answers = robot_template.answers(given | gripper | {"sensor": "lidar camera imu"}) | {
            "year": "2026",
            "into": ".",
        }
        create(robot_template, answers, folder)
        model = find_model([f"{folder}/{given['name']}_description"]).path
        urdf = folder / f"{given['name']}.urdf"
        assert main(["expand", str(model), "-o", str(urdf)]) == 0
        found[given["name"]] = (model, urdf)
    return folder, found


def joints_of(model):
    return {joint.name for joint in load(model).joints if joint.type != "fixed"}


def test_pinocchio(expanded):
    for model, urdf in expanded[1].values():
        built = pin.buildModelFromXML(urdf.read_text())
        assert set(built.names) - {"universe"} == joints_of(model)


def test_mujoco(expanded):
    for model, urdf in expanded[1].values():
        built = mujoco.MjModel.from_xml_string(urdf.read_text())
        assert {built.joint(k).name for k in range(built.njnt)} == joints_of(model)


@pytest.mark.ros
def test_check_urdf(expanded):
    if shutil.which("check_urdf") is None:
        pytest.skip("check_urdf not installed: apt-get install liburdfdom-tools")
    for _, urdf in expanded[1].values():
        done = subprocess.run(["check_urdf", urdf], capture_output=True, text=True, check=False)
        assert "Successfully Parsed XML" in done.stdout, done.stdout + done.stderr


@pytest.mark.ros
def test_the_real_sdformat_takes_models_and_worlds(expanded, sdformat):
    folder, found = expanded
    worlds = [*folder.glob("*_gazebo/worlds/*.sdf"), *folder.glob("*_gazebo/worlds/*.world")]
    assert len(worlds) == len(ROBOTS)
    included = "".join(f"<include><uri>{urdf}</uri></include>" for _, urdf in found.values())
    crowd = folder / "crowd.sdf"
    crowd.write_text(f'<sdf version="1.9"><world name="crowd">{included}</world></sdf>')
    lines = sdformat(*worlds, crowd)
    # Names of frames are Gazebo's own: sdformat says that it only passes them on.
    passed_on = [line for line in lines if line[0] == "error" and re.search(r"(gz|optical)_frame_id.*Copying", line[2])]
    assert [line for line in lines if line[0] == "error" and line not in passed_on] == []
    links = {line[1] for line in lines if line[0] == "link"}
    for model, _ in found.values():
        robot = load(model)  # whose links on fixed joints are lumped
        moving = {robot.joint_by_name[name].child for name in joints_of(model)}
        assert {f"{robot.name}::{link}" for link in moving} <= links
