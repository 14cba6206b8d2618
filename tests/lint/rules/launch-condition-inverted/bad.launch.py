from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
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
            condition=IfCondition(sim),  # <!-- expect: L127 -->
        ),
        Node(
            package="ros_gz_sim",
            executable="create",
            arguments=["-topic", "robot_description"],
            condition=UnlessCondition(sim),  # <!-- expect: L127 -->
        ),
        DeclareLaunchArgument("use_rviz", default_value="true"),
        Node(
            package="rviz2",
            executable="rviz2",
            condition=UnlessCondition(LaunchConfiguration("use_rviz")),  # <!-- expect: L127 -->
        ),
    ])
