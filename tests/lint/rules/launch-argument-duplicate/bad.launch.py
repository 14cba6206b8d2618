from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("name", default_value="rviz"),
        DeclareLaunchArgument("name", default_value="other"),  # <!-- expect: L115 -->
        Node(package="rviz2", executable="rviz2", name=LaunchConfiguration("name")),
    ])
