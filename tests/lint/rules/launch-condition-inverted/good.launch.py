from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, GroupAction
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    sim = LaunchConfiguration("use_sim")
    return LaunchDescription([
        DeclareLaunchArgument("use_sim", default_value="false"),
        Node(
            package="rplidar_ros",
            executable="rplidar_node",
            condition=UnlessCondition(sim),
        ),
        Node(
            package="ros_gz_sim",
            executable="create",
            arguments=["-topic", "robot_description"],
            condition=IfCondition(sim),
        ),
        DeclareLaunchArgument("use_rviz", default_value="true"),
        GroupAction(
            [Node(package="rviz2", executable="rviz2")], condition=IfCondition(LaunchConfiguration("use_rviz"))
        ),
    ])
