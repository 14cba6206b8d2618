"""What `urdfkit new robot` writes, and the robots we ship, are built, installed and launched by Debian's real tools."""

import os
import re
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


def shipped(build_tool):
    """Return robot → its packages, of those robots we ship that a build tool builds."""
    return {
        folder.name: packages
        for folder in sorted(robots_dir().iterdir())
        if (packages := [path.parent for path in sorted(folder.glob("*/package.xml"))])
        and f"<buildtool_depend>{build_tool}<" in (packages[0] / "package.xml").read_text()
    }


def test_catkin(workspace, with_xacro):
    """A new robot and all robots of ROS 1 that we ship, in one workspace."""
    require("catkin catkin-lint python3-roslaunch rospack-tools", "catkin_make", "catkin_lint", "roslaunch", "rospack")
    src = workspace / "src"
    new = {"scout": "diff", "skidder": "skid", "glider": "omni", "stander": "none"}
    for name, drive in new.items():
        sensors = ["--sensor", "lidar,lidar3d,camera,depth,imu,gps"] if name in ("skidder", "glider") else []
        more = ["--ros", "noetic", "--drive", drive, *sensors, "--into", "src", "--yes"]
        assert main(["new", "robot", name, *more]) == 0
    robots = shipped("catkin")
    assert len(robots) >= 6
    for package in (package for packages in robots.values() for package in packages):
        shutil.copytree(package, src / package.name)
    assert "found 0 problems" in run(workspace, "catkin_lint -W2 --strict --offline src")
    run(workspace, "catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    share = workspace / "install/share"
    stub_gazebo_ros(share)
    commands, names = [], [*new, *robots]
    for name in names:
        assert (share / f"{name}_description/urdf/{name}.urdf.xacro").is_file()
        assert list((share / f"{name}_gazebo/worlds").glob("*.world"))
        commands.append(f"echo FOUND $(rospack find {name}_description)")
        for launch in sorted(share.glob(f"{name}_*/launch/*.launch")):
            commands.append(f"echo LAUNCH; roslaunch --dump-params {launch.parents[1].name} {launch.name}")
    said = run(workspace, f"set -e; . install/setup.bash; export PATH={with_xacro}; {'; '.join(commands)}")
    said = re.sub(r"\\\n +(\\(?= ))?", "", said)  # YAML wraps long lines
    for name in names:
        assert f"FOUND {share / f'{name}_description'}\n" in said
        assert said.count(f'<robot name=\\"{name}\\"') + said.count(f'<robot name="{name}"') >= 2, name


def test_colcon(workspace):
    require(
        "colcon python3-colcon-{ros,cmake,recursive-crawl,output} ament-cmake",
        "colcon",
        "cmake",
        modules=("colcon_ros", "colcon_cmake", "colcon_recursive_crawl", "ament_package"),
    )
    new = {"scout": "diff", "skidder": "skid", "car": "ackermann", "glider": "omni", "stander": "none"}
    for name, drive in new.items():
        sensors = ["--sensor", "lidar,lidar3d,camera,depth,imu,gps"] if name in ("car", "glider") else []
        assert main(["new", "robot", name, "--drive", drive, *sensors, "--into", "src", "--yes"]) == 0
    robots = shipped("ament_cmake")
    assert len(robots) >= 3
    for package in (package for packages in robots.values() for package in packages):
        shutil.copytree(package, workspace / "src" / package.name)
    count = 3 * len(new) + sum(len(packages) for packages in robots.values())
    assert f"{count} packages finished" in run(workspace, "colcon build")
    for name, packages in robots.items():
        for package in packages:
            there = workspace / "install" / package.name / "share" / package.name
            assert {path.name for path in package.glob("launch/*")} <= {path.name for path in there.glob("launch/*")}
        model = workspace / f"install/{name}_description/share/{name}_description/urdf/{name}.urdf.xacro"
        assert load(model).name == name
    share = workspace / "install/scout_description/share"
    found = run(workspace, ". install/setup.sh && echo $GZ_SIM_RESOURCE_PATH")
    assert str(share) in found.split()[-1].split(":")
    for path in ("launch/scout.launch.py", "config/bridge.yaml", "worlds/empty.sdf"):
        assert (workspace / "install/scout_gazebo/share/scout_gazebo" / path).is_file()
    assert load(Path(share, "scout_description/urdf/scout.urdf.xacro")).name == "scout"
