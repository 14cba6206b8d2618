"""The sensors' tables: which plugin is which, and in whose spelling."""

from __future__ import annotations

import pytest

from urdfkit.description.plugins import match, read
from urdfkit.description.plugins.sensors.table import BARE, SENSORS
from urdfkit.description.urdf.parser import parse
from urdfkit.description.xml.reader import document_of
from urdfkit.description.xml.source import Source


def plugin_of(inside: str, filename: str):
    text = (
        f'<robot><gazebo reference="l"><sensor name="s" type="ray"><plugin name="p" filename="{filename}">{inside}'
        "</plugin></sensor></gazebo></robot>"
    )
    return parse(document_of(Source("f", text))).gazebo[0].sensors[0].plugins[0]


@pytest.mark.parametrize(
    ("filename", "inside", "kind", "generation"),
    [
        ("libgazebo_ros_camera.so", "<cameraName>c</cameraName>", "camera", "ros1"),
        ("libgazebo_ros_camera.so", "<camera_name>c</camera_name>", "camera", "ros2"),
        ("libgazebo_ros_openni_kinect.so", "", "openni_kinect", "ros1"),
        ("libgazebo_ros_depth_camera.so", "", "depth_camera", "ros1"),
        ("libgazebo_ros_laser.so", "<topicName>t</topicName>", "laser", "ros1"),
        ("libgazebo_ros_gpu_laser.so", "", "laser", "ros1"),
        ("libgazebo_ros_block_laser.so", "", "block_laser", "ros1"),
        ("libgazebo_ros_range.so", "", "range", "ros1"),
        ("libgazebo_ros_ray_sensor.so", "<output_type>sensor_msgs/LaserScan</output_type>", "ray_sensor", "ros2"),
        ("libgazebo_ros_velodyne_laser.so", "", "velodyne", "ros1"),
        ("libgazebo_ros_velodyne_laser.so", "<topicName>t</topicName><min_range>1</min_range>", "velodyne", "ros1"),
        (
            "libgazebo_ros_velodyne_gpu_laser.so",
            "<frame_name>f</frame_name><min_range>1</min_range>",
            "velodyne",
            "ros2",
        ),
        ("libgazebo_ros_velodyne_laser.so", "<ros/><max_range>9</max_range>", "velodyne", "ros2"),
    ],
)
def test_sensors_are_recognised(filename: str, inside: str, kind: str, generation: str) -> None:
    spec = match(plugin_of(inside, filename))
    assert spec is not None
    assert (spec.kind, spec.generation) == (kind, generation)


@pytest.mark.parametrize(
    ("filename", "inside", "expected"),
    [
        ("libgazebo_ros_laser.so", "", {"topic": "/world", "frame": "/world"}),
        (
            "libgazebo_ros_range.so",
            "",
            {"topic": "/range", "radiation": "ultrasound", "field_of_view": "0.05", "update_rate": "0"},
        ),
        ("libgazebo_ros_ray_sensor.so", "", {"output_type": "sensor_msgs/PointCloud2", "min_intensity": "0"}),
        ("libgazebo_ros_velodyne_laser.so", "", {"topic": "/points", "min_range": "0", "organize_cloud": "false"}),
    ],
)
def test_defaults_are_the_sources(filename: str, inside: str, expected: dict[str, str]) -> None:
    plugin = plugin_of(inside, filename)
    spec = match(plugin)
    assert spec is not None
    assert read(plugin, spec).items() >= expected.items()


def test_every_table_names_its_source_and_bare_sensors_have_one() -> None:
    assert all(spec.source for spec in (*SENSORS, *BARE.values()))
    assert set(BARE) >= {"ray", "gpu_ray", "lidar", "gpu_lidar", "camera", "depth_camera", "rgbd_camera"}
