from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["--z", "0.1", "--frame-id", "base_link", "--child-frame-id", "eye"],
        ),
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["0", "0", "0", "0", "0", "0", "base_link", "ear", "--ros-args", "--log-level", "warn"],
        ),
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=[*["0"] * 6, "base_link", LaunchConfiguration("frame", default="eye")],
        ),
    ])
