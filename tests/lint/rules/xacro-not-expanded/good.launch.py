import os

import xacro
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    file = os.path.join(get_package_share_directory("cart_description"), "urdf", "cart.urdf.xacro")
    document = xacro.parse(open(file))
    xacro.process_doc(document)
    name = "robot_state_publisher"
    node = Node(package=name, executable=name, parameters=[{"robot_description": document.toxml()}])
    return LaunchDescription([node])
