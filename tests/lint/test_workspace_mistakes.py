"""Mistakes in workspaces of several packages, each with the one finding that names it."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from tests.bench.package_mutants import bases, judging

ROVER, ARM = "ros2_rover_arm", "ros1_arm"

LAST = "install(DIRECTORY config DESTINATION share/${PROJECT_NAME})\n"
OWN = "exec_depend>titan_control</exec_depend"
BUILD = OWN.replace("exec_", "build_")
RUN_TIME = (
    "launch files need `titan_control` at run time, but <build_depend> does not install it "
    "write <exec_depend>, or <depend> if the build needs the package too"
)
SRDF = "gofer_moveit_config/config/gofer.srdf"
OUTSIDE = (
    "parent frame `tcp` of virtual joint `odom_joint` is a link of the robot "
    "write a frame outside the robot, such as `world`"
)
CARRIES = (
    "parent link `boom` of end effector `jaw_ee` does not carry group `jaw` write `hand`, or a link that is fixed to it"
)
FIXED = "virtual joint `odom_joint` is fixed to `odom`, but the robot has drive wheels write `planar`"
NEVER = "the reason is `Never`, but a joint connects links `turret` and `boom` write `Adjacent`"
URDF = "titan_description/urdf/titan.urdf.xacro"
OUTSIDE_PARENT = (
    "joint `joint_3` is 0.5 m outside its parent link `upper_arm_link`; "
    "all other moving joints are at their parent links check the axes, signs and units of the origin"
)
OPPOSITE_END = (
    "joint `joint_3` is at -0.25 m along `upper_arm_link`, not at the end of the link, 0.25 m "
    "check the sign of the origin"
)
STROKE = (
    "joint `joint_3` slides from -2.4 to 2.4 m, but the whole robot extends 1.09 m "
    "write the limits in metres, or use the type of a joint that turns"
)
CYLINDER = "the inertia of link `left_wheel_link` is that of a cylinder with radius and length swapped"
MISTAKES = [
    (ARM, URDF, '"joint_2" type', '"joint_1" type', 67, "T207", "duplicate joint `joint_1`"),
    (ARM, URDF, '"world_joint" type', '"joint_1" type', 37, "T207", "duplicate joint `joint_1`"),
    (ARM, URDF, 'xyz="0 0 0.25"', 'xyz="0 0 -0.25"', 100, "J427", OPPOSITE_END),
    (ARM, URDF, 'xyz="0 0 0.25"', 'xyz="0 0 -0.5"', 100, "J421", OUTSIDE_PARENT),
    (ARM, URDF, '"joint_3" type="revolute"', '"joint_3" type="prismatic"', 102, "J422", STROKE),
    (
        ROVER,
        "gofer_description/urdf/base.xacro",
        'radius}" h="${wheel_width',
        'width}" h="${wheel_radius',
        0,
        "I519",
        CYLINDER,
    ),
    (ROVER, "gofer_description/CMakeLists.txt", "NAME}\n", "NAME}/x\n", 8, "K973", "`share/gofer_description/x/"),
    (ROVER, "gofer_description/CMakeLists.txt", "launch meshes", "launch/ meshes", 8, "K973", "as `share/gofer_descri"),
    (
        ROVER,
        "gofer_moveit_config/CMakeLists.txt",
        f"{LAST}\nament_package()",
        f"ament_package()\n{LAST}",
        8,
        "K973",
        "last",
    ),
    (
        ARM,
        "titan_control/CMakeLists.txt",
        "find_package(c",
        "catkin_package()\nfind_package(c",
        4,
        "K973",
        "before find",
    ),
    (ROVER, "gofer_bringup/setup.cfg", "scripts=$base/lib/gofer_bringup", "scripts=$base/bin", 4, "K973", "to `bin`"),
    (
        ROVER,
        "gofer_moveit_config/package.xml",
        "<exec_depend>moveit_kinematics</exec_depend>",
        "",
        0,
        "K956",
        "file uses",
    ),
    (
        ROVER,
        "gofer_moveit_config/package.xml",
        "<exec_depend>gofer_description</exec_depend>",
        "",
        0,
        "K956",
        "MoveItCon",
    ),
    (ARM, "titan_moveit_config/package.xml", "<exec_depend>moveit_planners_ompl</exec_depend>", "", 0, "K956", "ompl`"),
    (
        ARM,
        "titan_gazebo/package.xml",
        "<exec_depend>gazebo_ros_control</exec_depend>",
        "",
        0,
        "K956",
        "the robot loads",
    ),
    (ARM, "titan_gazebo/package.xml", OWN, BUILD, 15, "K956", RUN_TIME),
    (
        ROVER,
        SRDF,
        'type="planar"',
        'type="fixed"',
        32,
        "M105",
        FIXED,
    ),
    (ROVER, SRDF, 'parent_frame="odom"', 'parent_frame="tcp"', 32, "M105", OUTSIDE),
    (ROVER, SRDF, 'parent_link="tcp"', 'parent_link="boom"', 31, "M105", CARRIES),
    (ROVER, SRDF, '"boom" reason="Adjacent"', '"boom" reason="Never"', 41, "M102", NEVER),
]
"""Workspace, file, text, its replacement, line of the finding in that file or 0 for another file, code, and words."""


@pytest.fixture(scope="module")
def workspaces(tmp_path_factory):
    made = {}
    for name in (ROVER, ARM):
        made[name] = tmp_path_factory.mktemp(name)
        bases.write(name, made[name])
    return made


@pytest.fixture(autouse=True)
def _here():
    folder = Path.cwd()
    yield
    os.chdir(folder)


@pytest.mark.parametrize(("base", "file", "old", "new", "line", "code", "words"), MISTAKES)
def test_each_mistake_has_one_finding(base, file, old, new, line, code, words, workspaces, tmp_path):
    shutil.copytree(workspaces[base], tmp_path, dirs_exist_ok=True)
    path = tmp_path / file
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new, 1))
    found = judging.lint(tmp_path)
    assert [each.code for each in found] == [code], found
    assert words in found[0].message
    assert not line or (found[0].file, found[0].first) == (file, line), found
