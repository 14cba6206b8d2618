from launch import LaunchDescription
from launch_ros.actions import Node

DESCRIPTION = {"robot_description": "<robot name='cart'><link name='base'/></robot>"}


def generate_launch_description():
    manager = Node(  # <!-- expect: L112 -->
        package="controller_manager", executable="ros2_control_node", parameters=[DESCRIPTION]
    )
    return LaunchDescription([manager])
