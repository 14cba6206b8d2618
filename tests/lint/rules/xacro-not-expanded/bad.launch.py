import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.substitutions import Command, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    file = os.path.join(get_package_share_directory("cart_description"), "urdf", "cart.urdf.xacro")
    with open(file) as description:  # <!-- expect: L119 -->
        text = description.read()
    path = PathJoinSubstitution([FindPackageShare("cart_description"), "urdf", "cart.urdf.xacro"])
    printed = Command(["cat ", path])  # <!-- expect: L119 -->
    name = "robot_state_publisher"
    first = Node(package=name, executable=name, parameters=[{"robot_description": text}])
    second = Node(package=name, executable=name, parameters=[{"robot_description": printed}])
    return LaunchDescription([first, second])
