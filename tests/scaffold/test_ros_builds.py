"""What `urdfkit new robot` writes, and the robots we ship, are built, installed and launched by Debian's real tools.

Every drive, without an arm and with one of 3 to 7 joints, in one workspace for each build tool. `test_ros_readers` has
every drive with every arm.
"""

import json
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from tests.scaffold.ros_stubs import write_launch_modules, write_packages, write_tools
from urdfkit.description import load
from urdfkit.resources import robots_dir
from urdfkit.scaffold import create

SYSTEM = "/usr/sbin:/usr/bin:/sbin:/bin"  # a Python of the user's own breaks Debian's tools


def run(folder, command, given="", **environment):
    """Run a shell command as a user of Debian's ROS would; return what it prints."""
    env = {"PATH": SYSTEM, "HOME": str(folder), "ROS_HOME": str(folder / "ros"), "LANG": "C.UTF-8"}
    env["SETUPTOOLS_USE_DISTUTILS"] = "stdlib"  # CMake asks distutils for paths, package by package
    env |= environment
    done = subprocess.run(
        ["/bin/bash", "-c", command], cwd=folder, env=env, capture_output=True, text=True, check=False, input=given
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


def written(template, ros):
    """Write every drive, with an arm, most with a gripper, and without; some with all sensors; return their names."""
    names = []
    for drive, joints in zip(DRIVES, "34567", strict=True):
        for arm in ({}, {"arm": joints, "gripper": "no" if joints == "4" else "yes"}):
            names.append(f"{drive}_arm" if arm else f"{drive}_bot")
            sensors = "lidar lidar3d camera depth imu gps" if drive in ("skid", "omni") else ""
            given = {"name": names[-1], "ros": ros, "drive": drive, "sensor": sensors, **arm}
            create(template, template.answers(given) | {"year": "2026", "into": "."}, Path("src"))
    return names


DRIVES = ("diff", "skid", "ackermann", "omni", "none")
TESTED = ["description", "gazebo", "control", "bringup"]


def without_compilers():
    """Return what spares CMake looking for compilers, once for each package, which none of these packages needs."""
    architecture = run(Path.cwd(), "gcc -print-multiarch").strip()
    known = [
        f"CMAKE_{language}_COMPILER_{key}" for language in ("C", "CXX") for key in ("ID_RUN=1", "ID=GNU", "FORCED=1")
    ]
    known += [f"CMAKE_LIBRARY_ARCHITECTURE={architecture}", "CMAKE_SIZEOF_VOID_P=8", "CATKIN_ENABLE_TESTING=OFF"]
    return " ".join(f"-D{each}" for each in known)


def launches(share, names, new):
    """Return the launch files that are installed for robots; of a new one those that include all others."""
    found = [path for name in names for path in sorted(share.glob(f"{name}_*/launch/*.launch"))]
    whole = [path for path in found if path.name in ("display.launch", "teleop.launch")]
    whole += [path for path in found if path.parents[1].name.endswith("_bringup") and path not in whole]
    return [path for path in found if path in whole or not path.parents[1].name.startswith(tuple(new))]


@pytest.mark.catkin
def test_catkin_make(robot_template, workspace):
    """New robots and all robots of ROS 1 that we ship, in one workspace: linted, built, tested, installed, launched."""
    src = workspace / "src"
    new = written(robot_template, "noetic")
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
    run(workspace, f"cd build && make {tests}", PATH=path)
    told = run(workspace, "catkin_test_results build/test_results")
    assert re.search(r"Summary: 1[0-9] tests, 0 errors, 0 failures, 0 skipped", told), told
    share = workspace / "install/share"
    shutil.copytree(src / "stubs/gazebo_ros/launch", share / "gazebo_ros/launch")
    names = [*new, *robots]
    for name in names:
        assert (share / f"{name}_description/urdf/{name}.urdf.xacro").is_file()
        assert list((share / f"{name}_gazebo/worlds").glob("*.world"))
    started = launches(share, names, new)
    assert {path.parents[1].name for path in started} >= {f"{name}_bringup" for name in new}
    asked = {
        "launches": [[launch.parents[1].name, launch.name] for launch in started],
        "packages": sorted(path.parent.name for name in names for path in share.glob(f"{name}_*/package.xml")),
    }
    reported = run(
        workspace, f". install/setup.bash; export PATH={path}; /usr/bin/python3 {DUMP}", given=json.dumps(asked)
    )
    reported = json.loads(reported[reported.index('{"places"') :])
    assert reported["places"] == {name: str(share / name) for name in asked["packages"]}
    loaded = [value for params in reported["params"] for value in params.values()]
    for name in names:
        assert sum(f'<robot name="{name}"' in value for value in loaded) >= 2, name


DUMP = Path(__file__).with_name("dump_params.py")


@pytest.mark.catkin
def test_catkin_build(robot_template, workspace):
    """The other build tool of ROS 1, which builds each package by itself."""
    new = written(robot_template, "noetic")
    count = len(list((workspace / "src").iterdir()))
    run(workspace, f"catkin config --init --install --env-cache --cmake-args {without_compilers()} >/dev/null")
    reported = run(workspace, "catkin build --no-status --no-color --no-notify")
    assert f"All {count + 1} packages succeeded!" in reported  # one of them its own
    for name in new:
        for package in ("description", "gazebo", "bringup"):
            assert (workspace / f"install/share/{name}_{package}/package.xml").is_file()


@pytest.mark.colcon
def test_colcon(robot_template, workspace):
    """New robots and all robots of ROS 2 that we ship, in one workspace: built, tested, installed, found, launched."""
    new = written(robot_template, "jazzy")
    robots = shipped("ament_cmake")
    assert len(robots) >= 3
    for package in (package for packages in robots.values() for package in packages):
        shutil.copytree(package, workspace / "src" / package.name)
    count = len(list((workspace / "src").iterdir()))
    assert count == sum(4 if name.endswith("_arm") else 3 for name in new) + sum(map(len, robots.values()))
    tested = " ".join(f"diff_arm_{package}" for package in TESTED)
    assert "4 packages finished" in run(workspace, f"colcon build --packages-select {tested}")
    rest = f"colcon build --packages-skip {tested} --cmake-args -DBUILD_TESTING=OFF"
    assert f"{count - 4} packages finished" in run(workspace, rest)
    write_launch_modules(workspace / "modules")
    write_tools(workspace / "bin")
    for packages in robots.values():
        for package in packages:
            there = workspace / "install" / package.name / "share" / package.name
            assert {path.name for path in package.glob("launch/*")} <= {path.name for path in there.glob("launch/*")}
    for name in (*new, *robots):
        share = workspace / f"install/{name}_description/share"
        assert load(share / f"{name}_description/urdf/{name}.urdf.xacro").name == name
    found = run(workspace, ". install/setup.sh && echo $GZ_SIM_RESOURCE_PATH").split()[-1].split(":")
    assert {str(workspace / f"install/{name}_description/share") for name in new} <= set(found)
    for name in new:
        share = workspace / f"install/{name}_gazebo/share/{name}_gazebo"
        for path in (f"launch/{name}.launch.py", "config/bridge.yaml", "worlds/empty.sdf"):
            assert (share / path).is_file()
    launch = [str(path) for path in sorted(workspace.glob("install/*/share/*/launch/*.launch.py"))]
    assert len(launch) >= count - len(robots)
    run(workspace, f"/usr/bin/python3 -c '{EXECUTED}'", json.dumps(launch), PYTHONPATH=str(workspace / "modules"))
    environment = {"PATH": f"{workspace}/bin:{SYSTEM}", "PYTHONPATH": str(workspace / "modules")}
    run(workspace, f"colcon test --packages-select {tested}", **environment)
    told = run(workspace, "colcon test-result --all")
    assert re.search(r"Summary: 1[0-9] tests, 0 errors, 0 failures, 0 skipped", told), told


EXECUTED = """
import json, sys
from launch.launch_description_sources import get_launch_description_from_python_launch_file as executed
for path in json.load(sys.stdin):
    assert executed(path).entities, path
"""
