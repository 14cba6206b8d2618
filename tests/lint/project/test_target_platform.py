"""What a package is for, from its package.xml."""

from __future__ import annotations

import pytest

from urdfkit.errors import UsageError
from urdfkit.lint.engine.run import run
from urdfkit.lint.project.entry_files import Entry
from urdfkit.lint.project.options import Options
from urdfkit.lint.project.target_platform import TARGETS, family_of, guess, parse_target

AMENT = "<export><build_type>ament_cmake</build_type></export>"
CATKIN = "<buildtool_depend>catkin</buildtool_depend>"


@pytest.mark.parametrize(
    ("inside", "target", "why"),
    [
        (AMENT, "ros2", "is built with ament_cmake"),
        (CATKIN, "ros1", "is built with catkin"),
        (CATKIN + AMENT, None, "is for ROS 1 and ROS 2"),
        (f"{AMENT}<exec_depend>ros_gz_sim</exec_depend>", "gz", "depends on ros_gz_sim"),
        (
            f"{AMENT}<exec_depend>ros_gz_sim</exec_depend><depend>gazebo_ros</depend>",
            "ros2",
            "is built with ament_cmake",
        ),
        (f"<!-- {CATKIN} -->{AMENT}", "ros2", "is built with ament_cmake"),
        ("<depend>rclpy</depend>", "ros2", "depends on rclpy"),
        ("<depend>rclpy</depend><depend>rospy</depend>", None, "is for ROS 1 and ROS 2"),
        ("<depend>xacro</depend>", None, "names no build tool"),
    ],
)
def test_the_build_tool_and_what_is_needed_tell(write, inside, target, why):
    write("p/package.xml", f"<package><name>p</name>{inside}</package>")
    found = guess(write("p/urdf/r.urdf", "<link name='a'/>"))
    assert (found.target, found.why) == (target, why)


def test_without_a_package_nothing_is_guessed(write):
    found = guess(write("r.urdf", "<link name='a'/>"))
    assert found.target is None


def test_a_run_says_what_it_was_for_and_each_package_has_its_own(write):
    body = '<link name="a"/><gazebo reference="a"><sensor name="s" type="ray"/></gazebo>'
    write("new/package.xml", f"<package><name>new</name>{AMENT}<depend>ros_gz_sim</depend></package>")
    write("old/package.xml", f"<package><name>old</name>{CATKIN}</package>")
    entries = [Entry(write("new/r.urdf", body)), Entry(write("old/r.urdf", body))]
    outcome = run(entries, Options(guess_target=True))
    assert [(finding.code, finding.file) for finding in outcome.findings] == [("Z817", "new/r.urdf")]
    assert outcome.notes == ("linted for gz: new depends on ros_gz_sim", "linted for ros1: old is built with catkin")
    assert run(entries, Options(guess_target=True, target="mujoco")).notes == ()
    assert run(entries, Options()).findings == ()


def test_many_packages_of_one_target_have_one_note(write):
    entries = []
    for name in ("a", "b", "c", "d"):
        write(f"{name}/package.xml", f"<package><name>{name}</name>{CATKIN}</package>")
        entries.append(Entry(write(f"{name}/r.urdf", '<link name="l"/>')))
    assert len(run(entries[:3], Options(guess_target=True)).notes) == 3
    note = "linted for ros1: a is built with catkin; also 3 other packages"
    assert run(entries, Options(guess_target=True)).notes == (note,)


@pytest.mark.parametrize(
    "name",
    [
        "ros1",
        "ros2",
        "gz",
        "classic",
        "mujoco",
        "isaac",
        "drake",
        "moveit",
        "urdfkit",
        "ros1-noetic",
        "ros2-humble",
        "gz-harmonic",
        "classic-11",
    ],
)
def test_targets_may_name_a_release(name):
    assert parse_target(name) == name
    assert family_of(name) in TARGETS


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("ros2-jazy", "did you mean `ros2-jazzy`"),
        ("gz-hamonic", "did you mean `gz-harmonic`"),
        ("mujocco", "did you mean `mujoco`"),
        ("ros1-x", "ros1 has hydro, "),
        ("ros2-noetic", "did you mean `ros1-noetic`"),
        ("xyz", "one of ros1, ros2, gz, "),
        ("isaac-5", "did you mean `isaac`"),
        ("Gazebo", "`gz` \\(gz sim\\) or `classic`"),
        ("ros", "`ros1` or `ros2`"),
        ("Humbel", "did you mean `humble`"),
        ("gz8", "gz has citadel, "),
        ("11", "one of ros1, "),
    ],
)
def test_a_target_that_is_misspelt_is_refused_with_the_nearest(name, message):
    with pytest.raises(UsageError, match=message):
        parse_target(name)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("ROS2", "ros2"),
        ("ros 2", "ros2"),
        ("Jazzy", "ros2-jazzy"),
        ("NOETIC", "ros1-noetic"),
        ("ros2_jazzy", "ros2-jazzy"),
        ("ros-jazzy", "ros2-jazzy"),
        ("ignition", "gz"),
        ("Ignition-Fortress", "gz-fortress"),
        ("gazebo_harmonic", "gz-harmonic"),
        ("gazebo11", "classic-11"),
        ("Gazebo-Classic", "classic"),
        ("MuJoCo", "mujoco"),
    ],
)
def test_case_and_other_names_do_not_matter(name, meant):
    assert parse_target(name) == meant


def test_a_release_alone_will_do():
    assert parse_target("noetic") == "ros1-noetic"
    assert parse_target("jazzy") == "ros2-jazzy"


def test_what_a_release_does_not_have_is_found(write):
    path = write(
        "r.urdf",
        '<link name="a"/><gazebo><plugin name="p" filename="libgazebo_ros_p3d.so"/></gazebo>'
        '<ros2_control name="s" type="system"><hardware><plugin>gazebo_ros2_control/GazeboSystem</plugin></hardware>'
        "</ros2_control>",
    )

    def codes(target):
        found = run([Entry(path)], Options(select=("Z807", "C709"), target=target)).findings
        return [finding.code for finding in found]

    assert codes("ros2-humble") == codes("ros2") == []
    assert codes("ros2-jazzy") == codes("rolling") == ["Z807", "C709"]
