"""What `urdfkit new robot` writes, and the robots we ship, are built, installed and launched by Debian's real tools."""

import itertools
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.scaffold.ros_stubs import write_launch_modules, write_packages, write_tools
from urdfkit.cli import main
from urdfkit.description import load
from urdfkit.resources import robots_dir
from urdfkit.scaffold import create

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


def shipped(build_tool):
    """Return robot → its packages, of those robots we ship that a build tool builds."""
    return {
        folder.name: packages
        for folder in sorted(robots_dir().iterdir())
        if (packages := [path.parent for path in sorted(folder.glob("*/package.xml"))])
        and f"<buildtool_depend>{build_tool}<" in (packages[0] / "package.xml").read_text()
    }


def written(template, ros, drives):
    """Write every drive, with an arm that grips and without, some with all sensors; return their names."""
    names = []
    for drive, joints in zip(drives, itertools.cycle("34567"), strict=False):
        for arm in ({}, {"arm": joints, "gripper": "yes"}):
            names.append(f"{drive}_arm" if arm else f"{drive}_bot")
            sensors = "lidar lidar3d camera depth imu gps" if drive in ("skid", "omni") else ""
            given = {"name": names[-1], "ros": ros, "drive": drive, "sensor": sensors, **arm}
            create(template, template.answers(given) | {"year": "2026", "into": "."}, Path("src"))
    return names


DRIVES = ("diff", "skid", "ackermann", "omni", "none")
TESTED = ["description", "gazebo", "control", "bringup"]


def test_catkin_make(robot_template, workspace):
    """New robots and all robots of ROS 1 that we ship, in one workspace: linted, built, tested, installed, launched."""
    require(
        "catkin catkin-lint python3-nose python3-roslaunch rospack-tools liburdfdom-tools",
        *("catkin_make", "catkin_lint", "roslaunch", "rospack", "nosetests3", "check_urdf"),
    )
    src = workspace / "src"
    new = written(robot_template, "noetic", DRIVES)
    robots = shipped("catkin")
    assert len(robots) >= 6
    for package in (package for packages in robots.values() for package in packages):
        shutil.copytree(package, src / package.name)
    assert "found 0 problems" in run(workspace, "catkin_lint -W2 --strict --offline src")
    write_packages(src / "stubs")
    write_tools(workspace / "bin")
    path = f"{workspace}/bin:{SYSTEM}"
    run(workspace, "catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 install")
    tests = " ".join(f"run_tests_diff_arm_{package}" for package in TESTED)
    run(workspace, f"catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3 {tests}", PATH=path)
    told = run(workspace, "catkin_test_results build/test_results")
    assert re.search(r"Summary: 1[0-9] tests, 0 errors, 0 failures, 0 skipped", told), told
    share = workspace / "install/share"
    shutil.copytree(src / "stubs/gazebo_ros/launch", share / "gazebo_ros/launch")
    commands, names = [], [*new, *robots]
    for name in names:
        assert (share / f"{name}_description/urdf/{name}.urdf.xacro").is_file()
        assert list((share / f"{name}_gazebo/worlds").glob("*.world"))
        commands.append(f"echo FOUND $(rospack find {name}_description)")
        started = sorted(share.glob(f"{name}_*/launch/*.launch"))
        if name in new:  # what starts everything includes the rest
            started = [path for path in started if path.name in (f"{name}.launch", "display.launch")]
        for launch in started:
            commands.append(f"echo LAUNCH; roslaunch --dump-params {launch.parents[1].name} {launch.name}")
    said = run(workspace, f"set -e; . install/setup.bash; export PATH={path}; {'; '.join(commands)}")
    said = re.sub(r"\\\n +(\\(?= ))?", "", said)  # YAML wraps long lines
    for name in names:
        assert f"FOUND {share / f'{name}_description'}\n" in said
        assert said.count(f'<robot name=\\"{name}\\"') + said.count(f'<robot name="{name}"') >= 2, name


def test_catkin_build(workspace):
    """The other build tool of ROS 1, which builds each package by itself."""
    require("catkin-tools", "catkin")
    assert main(["new", "robot", "rover", "--ros", "noetic", "--arm", "5", "--into", "src", "--yes", "-q"]) == 0
    said = run(
        workspace, "catkin config --init --install >/dev/null && catkin build --no-status --no-color --no-notify"
    )
    assert "All 5 packages succeeded!" in said  # one of them its own
    for package in TESTED:
        assert (workspace / f"install/share/rover_{package}/package.xml").is_file()


def test_colcon(robot_template, workspace):
    """New robots and all robots of ROS 2 that we ship, in one workspace: built, tested, installed, found."""
    require(
        "colcon python3-colcon-{ros,cmake,recursive-crawl,output,test-result} ament-cmake ament-cmake-pytest "
        "liburdfdom-tools",
        *("colcon", "cmake", "check_urdf"),
        modules=("colcon_ros", "colcon_cmake", "colcon_recursive_crawl", "colcon_test_result", "ament_package"),
    )
    new = written(robot_template, "jazzy", DRIVES)
    robots = shipped("ament_cmake")
    assert len(robots) >= 3
    for package in (package for packages in robots.values() for package in packages):
        shutil.copytree(package, workspace / "src" / package.name)
    count = len(list((workspace / "src").iterdir()))
    assert count == sum(4 if name.endswith("_arm") else 3 for name in new) + sum(map(len, robots.values()))
    assert f"{count} packages finished" in run(workspace, "colcon build")
    for name, packages in robots.items():
        for package in packages:
            there = workspace / "install" / package.name / "share" / package.name
            assert {path.name for path in package.glob("launch/*")} <= {path.name for path in there.glob("launch/*")}
        model = workspace / f"install/{name}_description/share/{name}_description/urdf/{name}.urdf.xacro"
        assert load(model).name == name
    share = workspace / "install/diff_bot_description/share"
    found = run(workspace, ". install/setup.sh && echo $GZ_SIM_RESOURCE_PATH")
    assert str(share) in found.split()[-1].split(":")
    for path in ("launch/diff_bot.launch.py", "config/bridge.yaml", "worlds/empty.sdf"):
        assert (workspace / "install/diff_bot_gazebo/share/diff_bot_gazebo" / path).is_file()
    assert load(Path(share, "diff_bot_description/urdf/diff_bot.urdf.xacro")).name == "diff_bot"
    write_launch_modules(workspace / "modules")
    write_tools(workspace / "bin")
    packages = " ".join(f"diff_arm_{package}" for package in TESTED)
    run(
        workspace,
        f"colcon test --packages-select {packages}",
        PATH=f"{workspace}/bin:{SYSTEM}",
        PYTHONPATH=str(workspace / "modules"),
    )
    told = run(workspace, "colcon test-result --all")
    assert re.search(r"Summary: 1[0-9] tests, 0 errors, 0 failures, 0 skipped", told), told
