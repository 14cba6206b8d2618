from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    description = {"robot_description": "<robot name='cart'><link name='base'/></robot>"}
    return LaunchDescription([
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description]),
        Node(package="controller_manager", executable="spawner.py", arguments=["arm"]),
    ])
