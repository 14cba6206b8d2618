from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    description = {"robot_description": "<robot name='cart'><link name='base'/></robot>"}
    return LaunchDescription([
        Node(package="robot_state_publisher", executable="state_publisher", parameters=[description]),  # <!-- expect: L103 -->
        Node(package="controller_manager", executable="controller_group", arguments=["arm"]),  # <!-- expect: L103 -->
        Node(package="robot_localization", executable="ekf_localization_node"),  # <!-- expect: L103 -->
        Node(package="gazebo_ros", executable="create", arguments=["-entity", "cart"]),  # <!-- expect: L103 -->
    ])
