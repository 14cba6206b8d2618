"""Plugin tables: names, generations, values."""

from __future__ import annotations

import pytest

from urdfkit.description.plugins import ALL_SPECS, match, read, read_all
from urdfkit.description.plugins.lookup import stem
from urdfkit.description.urdf.parser import parse
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source


def plugin_of(inside: str, filename: str = "libgazebo_ros_diff_drive.so", name: str = "p"):
    text = f'<robot><gazebo><plugin name="{name}" filename="{filename}">{inside}</plugin></gazebo></robot>'
    return parse(document_of(Source("f", text))).gazebo[0].plugins[0]


@pytest.mark.parametrize(
    ("filename", "expected"),
    [
        ("libgazebo_ros_diff_drive.so", "gazebo_ros_diff_drive"),
        ("/opt/ros/lib/libgazebo_ros_diff_drive.so", "gazebo_ros_diff_drive"),
        ("gazebo_ros_diff_drive", "gazebo_ros_diff_drive"),
        ("libgazebo_ros_diff_drive\n   .so", "gazebo_ros_diff_drive"),
        ("gz-sim7-diff-drive-system", "gz-sim-diff-drive-system"),
        ("libgz-sim-diff-drive-system.so", "gz-sim-diff-drive-system"),
        ("ignition-gazebo6-diff-drive-system", "ignition-gazebo-diff-drive-system"),
    ],
)
def test_file_names(filename, expected):
    assert stem(filename) == expected


@pytest.mark.parametrize(
    ("inside", "filename", "generation"),
    [
        ("<leftJoint>l</leftJoint>", "libgazebo_ros_diff_drive.so", "ros1"),
        ("", "libgazebo_ros_diff_drive.so", "ros1"),
        ("<left_joint>l</left_joint>", "libgazebo_ros_diff_drive.so", "ros2"),
        ("<ros/><leftJoint>l</leftJoint>", "libgazebo_ros_diff_drive.so", "ros2"),
        ("<left_joint>l</left_joint><alwaysOn/><wheel_diameter/>", "libgazebo_ros_diff_drive.so", "ros2"),
        ("<left_joint>l</left_joint>", "gz-sim-diff-drive-system", "gz"),
    ],
)
def test_generations_are_told_apart(inside, filename, generation):
    spec = match(plugin_of(inside, filename))
    assert spec is not None
    assert (spec.kind, spec.generation) == ("diff_drive", generation)


def test_unknown_plugins():
    assert match(plugin_of("", "libmine.so")) is None


def test_values_defaults_and_repetitions():
    plugin = plugin_of(
        "<left_joint> a </left_joint><left_joint>b</left_joint><right_joint>c</right_joint>"
        "<wheel_separation>0.5</wheel_separation>"
    )
    spec = match(plugin)
    assert spec is not None
    values = read(plugin, spec)
    assert (values["left_joint"], values["wheel_separation"], values["wheel_diameter"]) == ("a", "0.5", "0.15")
    assert "ros" not in values
    assert read_all(plugin, spec)["left_joint"] == ("a", "b")
    states = plugin_of("<jointName>a, b</jointName>", "libgazebo_ros_joint_state_publisher.so")
    assert read_all(states, match(states))["joints"] == ("a", "b")


def test_tables_are_consistent():
    for spec in ALL_SPECS:
        tags = [parameter.tag for parameter in spec.parameters]
        meanings = [parameter.meaning for parameter in spec.parameters]
        assert len(set(tags)) == len(tags)
        assert len(set(meanings)) == len(meanings)
        assert spec.filenames
        assert all(stem(name) == name for name in spec.filenames)
        assert bool(spec.class_names) is (spec.generation == "gz")
        assert spec.source
    keys = [(spec.kind, spec.generation) for spec in ALL_SPECS]
    assert len(set(keys)) == len(keys)
