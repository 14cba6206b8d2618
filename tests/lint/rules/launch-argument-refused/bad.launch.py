from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, LaunchConfigurationEquals
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("view", default_value="top", choices=["front", "side"]),  # <!-- expect: L125 -->
            DeclareLaunchArgument("gui", default_value="no"),  # <!-- expect: L125 -->
            Node(package="rviz2", executable="rviz2", name="a", condition=IfCondition(LaunchConfiguration("gui"))),
            Node(
                package="rviz2",
                executable="rviz2",
                name="b",
                condition=LaunchConfigurationEquals("view", "sides"),  # <!-- expect: L125 -->
            ),
        ]
    )
