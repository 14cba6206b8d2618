"""Whoever reads URDF takes every drive with every arm: check_urdf, sdformat, Pinocchio and MuJoCo."""

import subprocess

import pytest

from urdfkit.description import load
from urdfkit.description.xacro.expand import expand
from urdfkit.resources import find_model
from urdfkit.scaffold import create

DRIVES = ("diff", "skid", "ackermann", "omni", "none")
ARMS = ("none", "3", "4", "5", "6", "7")


@pytest.fixture(scope="module")
def robots(robot_template, tmp_path_factory):
    """Every drive with every arm, in both generations, by turns with a gripper: URDF file → its robot."""
    found = {}
    for ros in ("jazzy", "noetic"):
        for i, (drive, arm) in enumerate((drive, arm) for drive in DRIVES for arm in ARMS):
            given = {"name": f"{drive}_{arm}", "ros": ros, "drive": drive, "arm": arm}
            if arm != "none":
                given["gripper"] = ("yes", "no")[i % 2]
            folder = tmp_path_factory.mktemp(f"{ros}_{drive}_{arm}")
            create(robot_template, robot_template.answers(given) | {"year": "2026", "into": "."}, folder)
            model = find_model([f"{folder}/{drive}_{arm}_description"]).path
            path = folder / "robot.urdf"
            path.write_text(expand(model).xml)
            found[path] = load(model)
    return found


@pytest.mark.slow
@pytest.mark.check_urdf
def test_check_urdf(robots):
    for path in robots:
        done = subprocess.run(["check_urdf", path], capture_output=True, text=True, check=False)
        assert done.returncode == 0, (path, done.stderr)
        assert done.stderr == "", path


def crowd(world, paths):
    """Write a world with these robots in it, as it is models in worlds that are converted; return it."""
    included = "".join(f"<include><uri>{path}</uri></include>" for path in paths)
    world.write_text(f'<sdf version="1.9"><world name="crowd">{included}</world></sdf>')
    return world


@pytest.mark.sdformat
def test_sdformat_converts_it_and_takes_the_worlds(robots, sdformat, tmp_path):
    worlds = [world for path in list(robots)[:1] + list(robots)[-1:] for world in path.parent.glob("*/worlds/*")]
    assert {world.suffix for world in worlds} == {".sdf", ".world"}
    crowds = [
        crowd(tmp_path / f"{ros}.sdf", [path for path in robots if ros in str(path)]) for ros in ("jazzy", "noetic")
    ]
    lines = sdformat(*crowds, *worlds)
    assert [line for line in lines if line[0] == "error"] == []
    links = {line[1] for line in lines if line[0] == "link"}
    for robot in robots.values():  # what is on fixed joints is lumped together
        assert {f"{robot.name}::{joint.child}" for joint in robot.joints if joint.is_movable} <= links


@pytest.mark.slow
def test_pinocchio_and_mujoco(robots):
    import pinocchio

    mujoco = pytest.importorskip("mujoco")
    for path, robot in robots.items():
        joints = sum(joint.is_movable for joint in robot.joints)
        assert mujoco.MjModel.from_xml_path(str(path)).nv == joints, path
        # Pinocchio reads <mimic> only where it is told to.
        assert pinocchio.buildModelFromUrdf(str(path)).nv == joints, path
