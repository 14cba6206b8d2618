from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def later(context):
    return [DeclareLaunchArgument("name", default_value="third")]


def generate_launch_description():
    is_other = IfCondition("false")
    return LaunchDescription([
        DeclareLaunchArgument("name", default_value="rviz"),
        DeclareLaunchArgument("name", default_value="rviz"),
        DeclareLaunchArgument("name", default_value="other", condition=is_other),
        GroupAction([DeclareLaunchArgument("name", default_value="inner")]),
        Node(package="rviz2", executable="rviz2", name=LaunchConfiguration("name")),
        OpaqueFunction(function=later),
    ])
