from launch import LaunchDescription
from launch_ros.actions import Node

DESCRIPTION = {"robot_description": "<robot name='cart'><link name='base'/></robot>"}


def generate_launch_description():
    manager = Node(
        package="controller_manager", executable="ros2_control_node", parameters=[DESCRIPTION]  # <!-- expect: L112 -->
    )
    return LaunchDescription([manager])
