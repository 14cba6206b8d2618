"""What `urdfkit new robot` writes is built, installed and launched by the real tools (Debian's)."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.resources import robots_dir

pytestmark = pytest.mark.ros

SYSTEM = "/usr/sbin:/usr/bin:/sbin:/bin"  # a Python of the user's own breaks Debian's tools


def require(packages, *programs, modules=()):
    missing = [program for program in programs if shutil.which(program, path=SYSTEM) is None]
    missing += [m for m in modules if subprocess.run(["/usr/bin/python3", "-c", f"import {m}"], check=False).returncode]
    if missing:
        reason = f"{', '.join(missing)} not installed: apt-get install {packages}"
        if os.environ.get("CI"):
            pytest.fail(reason)
        pytest.skip(reason)


def run(folder, command, **environment):
    """Run a shell command as a user of Debian's ROS would; return what it prints."""
    env = {"PATH": SYSTEM, "HOME": str(folder), "ROS_HOME": str(folder / "ros"), "LANG": "C.UTF-8", **environment}
    done = subprocess.run(
        ["/bin/bash", "-c", command], cwd=folder, env=env, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    return done.stdout + done.stderr


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    (tmp_path / "src").mkdir()
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def with_xacro(tmp_path):
    """Return a PATH with an `xacro` on it (Debian packages none)."""
    tool = tmp_path / "bin" / "xacro"
    tool.parent.mkdir()
    tool.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m urdfkit expand "$@"\n')
    tool.chmod(0o755)
    return f"{tool.parent}:{SYSTEM}"


def stub_gazebo_ros(src):
    """Write the one file of gazebo_ros that the launch file includes."""
    package = src / "gazebo_ros"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text(
        '<package format="2"><name>gazebo_ros</name><version>0.0.0</version><description>stub</description>'
        '<maintainer email="a@b.c">a</maintainer><license>none</license></package>'
    )
    names = ("world_name", "gui", "paused", "use_sim_time")
    arguments = "".join(f'<arg name="{name}"/>' for name in names)
    (package / "launch/empty_world.launch").write_text(f"<launch>{arguments}</launch>")


@pytest.mark.parametrize("name", ["scout", "simpleton"])
def test_catkin(workspace, with_xacro, name):
    require("catkin catkin-lint python3-roslaunch rospack-tools", "catkin_make", "catkin_lint", "roslaunch", "rospack")
    src = workspace / "src"
    if name == "simpleton":
        for package in robots_dir().glob("simpleton/*_*"):
            shutil.copytree(package, src / package.name)
    else:
        assert main(["new", "robot", name, "--ros", "noetic", "--into", "src", "--yes"]) == 0
    assert "found 0 problems" in run(workspace, "catkin_lint -W2 --strict --offline src")
    run(workspace, "catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    share = workspace / "install/share"
    for path in (f"{name}_description/urdf/{name}.urdf.xacro", f"{name}_gazebo/worlds/empty.world"):
        assert (share / path).is_file()
    stub_gazebo_ros(share)
    sourced = ". install/setup.bash"
    assert run(workspace, f"{sourced}; rospack find {name}_description").strip() == str(share / f"{name}_description")
    for launch in (f"{name}_description display.launch", f"{name}_gazebo {name}.launch"):
        dumped = run(workspace, f"{sourced}; export PATH={with_xacro}; roslaunch --dump-params {launch}")
        assert f'<robot name=\\"{name}\\"' in dumped or f'<robot name="{name}"' in dumped


def test_colcon(workspace):
    require(
        "colcon python3-colcon-{ros,cmake,recursive-crawl,output} ament-cmake",
        "colcon",
        "cmake",
        modules=("colcon_ros", "colcon_cmake", "colcon_recursive_crawl", "ament_package"),
    )
    assert main(["new", "robot", "scout", "--ros", "jazzy", "--into", "src", "--yes"]) == 0
    assert "2 packages finished" in run(workspace, "colcon build")
    share = workspace / "install/scout_description/share"
    found = run(workspace, ". install/setup.sh && echo $GZ_SIM_RESOURCE_PATH")
    assert str(share) in found.split()[-1].split(":")
    for path in ("launch/scout.launch.py", "config/bridge.yaml", "worlds/empty.sdf"):
        assert (workspace / "install/scout_gazebo/share/scout_gazebo" / path).is_file()
    assert load(Path(share, "scout_description/urdf/scout.urdf.xacro")).name == "scout"
