from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    gui = LaunchConfiguration("gui")  # <!-- expect: L101 -->
    return LaunchDescription([Node(package="cart_description", executable="cart", name=[gui])])
