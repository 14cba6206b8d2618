from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, LaunchConfigurationEquals
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("view", default_value="front", choices=["front", "side"]),
            DeclareLaunchArgument("gui", default_value="false"),
            Node(package="rviz2", executable="rviz2", name="a", condition=IfCondition(LaunchConfiguration("gui"))),
            Node(
                package="rviz2",
                executable="rviz2",
                name="b",
                condition=LaunchConfigurationEquals("view", "side"),
            ),
        ]
    )
