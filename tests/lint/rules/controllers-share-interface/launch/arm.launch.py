from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="controller_manager", executable="spawner", arguments=["arm_controller", "hand_controller"]),
        Node(package="controller_manager", executable="spawner", arguments=["spare_controller", "--inactive"]),
    ])
