"""What holds for every robot we ship: it lints clean, is sound, and every reader takes it."""

import math
import subprocess

import numpy as np
import pytest

from urdfkit.description import load
from urdfkit.description.sdf import load_world
from urdfkit.description.xacro.expand import expand
from urdfkit.kinematics import Kinematics
from urdfkit.lint import lint
from urdfkit.resources import find_model, robot_names, robots_dir

FOLDERS = [path for path in sorted(robots_dir().iterdir()) if path.is_dir()]


@pytest.fixture(scope="module", params=robot_names())
def name(request):
    return request.param


@pytest.fixture(scope="module")
def robot(name):
    return load(find_model([name]).path)


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_nothing_to_find(folder):
    assert [str(finding) for finding in lint([folder])] == []


@pytest.mark.parametrize("folder", FOLDERS, ids=lambda folder: folder.name)
def test_it_is_packages_with_all_they_need(folder):
    packages = [path.parent for path in sorted(folder.glob("*/package.xml"))]
    names = {package.name for package in packages}
    assert {f"{folder.name}_description", f"{folder.name}_gazebo"} <= names
    assert (folder / "README.md").is_file()
    for package in packages:
        written = (package / "package.xml").read_text()
        assert f"<name>{package.name}</name>" in written
        assert {"CMakeLists.txt", "LICENSE", "README.md", "launch"} <= {path.name for path in package.iterdir()}
        installed = (package / "CMakeLists.txt").read_text().partition("install(DIRECTORY ")[2].split("\n")[0].split()
        folders = {path.name for path in package.iterdir() if path.is_dir()}
        shipped = folders - {"hooks", "__pycache__", "test"}
        assert set(installed) == shipped, package.name
        if (package / "test").is_dir():
            assert "catkin_add_nosetests(test)" in (package / "CMakeLists.txt").read_text()
        for other in names - {package.name}:
            used = any(other in path.read_text() for path in package.glob("launch/*"))
            assert used == (f"<exec_depend>{other}</exec_depend>" in written), (package.name, other)


def test_it_is_named_as_its_model(name, robot):
    assert robot.name == name
    assert len(robot.roots()) == 1


def test_masses_are_those_of_bodies_of_that_size(robot):
    """The inertia of a body is at most that of its mass at its farthest corner, and obeys the triangle inequality."""
    for link in robot.links:
        if link.inertial is None:
            continue
        i = link.inertial.inertia
        tensor = np.array([[i.ixx, i.ixy, i.ixz], [i.ixy, i.iyy, i.iyz], [i.ixz, i.iyz, i.izz]])
        a, b, c = np.linalg.eigvalsh(tensor)
        assert a > 0, link.name
        assert a + b >= c * (1 - 1e-9), link.name
        reach = max((_reach(collision) for collision in link.collisions), default=0.0)
        assert c <= link.inertial.mass * reach**2 * (1 + 1e-9), link.name


def _reach(collision):
    """Return the distance from the link's frame to the farthest point of a shape at most [m]."""
    shape = collision.geometry
    size = getattr(shape, "size", None)
    half = math.hypot(*size) / 2 if size is not None else math.hypot(shape.radius, getattr(shape, "length", 0.0) / 2)
    return math.hypot(*collision.origin.xyz) + half


def test_left_is_left(robot):
    """REP 103: y points to the left."""
    kinematics = Kinematics(robot)
    place = dict(zip(kinematics.link_names, kinematics.link_poses(kinematics.neutral()), strict=True))
    for link in place:
        mirrored = link.replace("left", "right")
        if mirrored != link:
            assert place[link][1] > 0 > place[mirrored][1], link
            assert place[link][1] == pytest.approx(-place[mirrored][1], abs=1e-12)


def test_every_frame_of_a_plugin_is_there(robot):
    for block in robot.gazebo:
        for sensor in block.sensors:
            for plugin in sensor.plugins:
                frames = [c.text for c in plugin.element.children if c.tag in ("frameName", "frame_name")]
                assert set(frames) <= set(robot.link_by_name), (sensor.name, frames)


@pytest.mark.check_urdf
def test_check_urdf_accepts_it(tmp_path, name):
    path = tmp_path / f"{name}.urdf"
    path.write_text(expand(find_model([name]).path).xml)
    done = subprocess.run(["check_urdf", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""


def test_pinocchio_and_mujoco_take_it(name, robot):
    import pinocchio

    mujoco = pytest.importorskip("mujoco")
    xml = expand(find_model([name]).path).xml
    joints = sum(joint.is_movable for joint in robot.joints)
    assert pinocchio.buildModelFromXML(xml).nv == joints
    assert mujoco.MjModel.from_xml_string(xml).nv == joints


@pytest.mark.parametrize("path", sorted(robots_dir().glob("*/*/worlds/*")), ids=lambda path: path.name)
def test_its_worlds_load(path):
    world = load_world(path)
    assert world.name == path.stem
    assert world.ground is not None
