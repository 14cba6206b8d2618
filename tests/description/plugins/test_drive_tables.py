"""The drives' tables: defaults of each generation as the plugins' sources have them, and how they are told apart."""

from __future__ import annotations

import pytest

from urdfkit.description.plugins import match, read
from urdfkit.description.plugins.drives.table import DRIVES
from urdfkit.description.urdf.parser import parse
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source


def plugin_of(inside: str, filename: str, name: str = "p"):
    text = f'<robot><gazebo><plugin name="{name}" filename="{filename}">{inside}</plugin></gazebo></robot>'
    return parse(document_of(Source("f", text))).gazebo[0].plugins[0]


@pytest.mark.parametrize(
    ("filename", "inside", "kind", "generation"),
    [
        ("libgazebo_ros_skid_steer_drive.so", "<covariance_x>1</covariance_x>", "skid_steer", "ros1"),
        ("libgazebo_ros_planar_move.so", "<commandTopic>c</commandTopic>", "planar_move", "ros1"),
        ("libgazebo_ros_planar_move.so", "", "planar_move", "ros1"),
        ("libgazebo_ros_planar_move.so", "<publish_rate>20</publish_rate>", "planar_move", "ros2"),
        ("libgazebo_ros_tricycle_drive.so", "<wheelTorque>1</wheelTorque>", "tricycle", "ros1"),
        ("libgazebo_ros_tricycle_drive.so", "<ros/>", "tricycle", "ros2"),
        ("libgazebo_ros_ackermann_drive.so", "", "ackermann", "ros2"),
        ("gz-sim-ackermann-steering-system", "", "ackermann_steering", "gz"),
        ("ignition-gazebo6-velocity-control-system", "", "velocity_control", "gz"),
        ("gz-sim8-mecanum-drive-system", "", "mecanum_drive", "gz"),
        ("libgz-sim-odometry-publisher-system.so", "", "odometry_publisher", "gz"),
    ],
)
def test_drives_are_recognised(filename: str, inside: str, kind: str, generation: str) -> None:
    spec = match(plugin_of(inside, filename))
    assert spec is not None
    assert (spec.kind, spec.generation) == (kind, generation)


@pytest.mark.parametrize(
    ("filename", "inside", "expected"),
    [
        (
            "libgazebo_ros_skid_steer_drive.so",
            "",
            {
                "wheel_separation": "0.4",
                "wheel_diameter": "0.15",
                "max_wheel_torque": "5",
                "update_rate": "100",
                "publish_odometry_tf": "false",
                "covariance_yaw": "0.01",
            },
        ),
        (
            "libgazebo_ros_planar_move.so",
            "",
            {
                "command_topic": "cmd_vel",
                "odometry_rate": "20",
                "command_timeout": "-1",
                "base_frame": "base_footprint",
            },
        ),
        (
            "libgazebo_ros_planar_move.so",
            "<ros/>",
            {"update_rate": "20", "odometry_rate": "20", "publish_odometry": "true", "publish_odometry_tf": "true"},
        ),
        (
            "libgazebo_ros_tricycle_drive.so",
            "",
            {
                "max_wheel_torque": "5",
                "wheel_separation": "0.5",
                "base_frame": "base_link",
                "odometry_source": "world",
                "steering_speed": "0",
                "steering_tolerance": "0.01",
                "steering_joint": "front_steering_joint",
            },
        ),
        (
            "libgazebo_ros_tricycle_drive.so",
            "<ros/>",
            {
                "max_wheel_torque": "0.15",
                "wheel_separation": "0.5",
                "publish_odometry": "false",
                "odometry_source": "1",
            },
        ),
        (
            "libgazebo_ros_ackermann_drive.so",
            "",
            {
                "max_speed": "20",
                "max_steer": "0.6",
                "max_steering_angle": "7.85",
                "speed_gains": "0 0 0",
                "left_steering_range": "0 0",
                "update_rate": "100",
                "publish_odometry": "false",
                "publish_distance": "false",
            },
        ),
        (
            "gz-sim-ackermann-steering-system",
            "",
            {
                "wheel_separation": "1.0",
                "kingpin_width": "0.8",
                "wheel_base": "1.0",
                "wheel_radius": "0.2",
                "max_steer": "0.5",
                "steer_p": "1",
                "odometry_rate": "50",
                "odometry_topic": "/model/{model}/odometry",
            },
        ),
        ("gz-sim-velocity-control-system", "", {"command_topic": "/model/{model}/cmd_vel"}),
        (
            "gz-sim-mecanum-drive-system",
            "",
            {"wheel_separation": "1.0", "wheel_base": "1.0", "wheel_radius": "0.2", "odometry_rate": "50"},
        ),
        (
            "gz-sim-odometry-publisher-system",
            "",
            {
                "odometry_frame": "{model}/odom",
                "base_frame": "{model}/base_footprint",
                "odometry_rate": "50",
                "tf_topic": "/model/{model}/pose",
                "dimensions": "2",
                "gaussian_noise": "0",
            },
        ),
    ],
)
def test_defaults(filename: str, inside: str, expected: dict[str, str]) -> None:
    plugin = plugin_of(inside, filename)
    spec = match(plugin)
    assert spec is not None
    found = read(plugin, spec)
    assert {meaning: found.get(meaning) for meaning in expected} == expected


@pytest.mark.parametrize("spec", DRIVES, ids=lambda spec: f"{spec.kind}-{spec.generation}")
def test_tables_name_their_source_and_each_tag_once(spec) -> None:
    tags = [parameter.tag for parameter in spec.parameters]
    meanings = [parameter.meaning for parameter in spec.parameters]
    assert len(set(tags)) == len(tags)
    assert len(set(meanings)) == len(meanings)
    assert "gazebo_ros_pkgs" in spec.source or "gz-sim" in spec.source
    assert bool(spec.class_names) is (spec.generation == "gz")
