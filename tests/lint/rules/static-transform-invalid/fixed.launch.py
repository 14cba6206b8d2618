from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["--z", "0.1", "--frame-id", "base_link", "--child-frame-id", "eye"],  # <!-- expect: L118 -->
        ),
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["--z", "0.1", "--child-frame-id", "eye"],  # <!-- expect: L118 -->
        ),
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["--frame-id", "base_link", "--child-frame-id", "base_footprint"],  # <!-- expect: L118 -->
        ),
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["--speed", "1", "--frame-id", "base_link", "--child-frame-id", "eye"],  # <!-- expect: L118 -->
        ),
        Node(
            package="tf2_ros",
            executable="static_transform_publisher",
            arguments=["--yaw", "1", "--qw", "1", "--frame-id", "base_link", "--child-frame-id", "a"],  # <!-- expect: L118 -->
        ),
    ])
