from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    model = LaunchConfiguration("model")  # <!-- expect: L101 -->
    speed = LaunchConfiguration("speed")  # <!-- expect: L101 -->
    height = LaunchConfiguration("height", default="1")
    gui = LaunchConfiguration("gui")
    node = [LaunchConfiguration(variable_name="use_gui"), LaunchConfiguration("use_gui")]
    return LaunchDescription([
        DeclareLaunchArgument("model", default_value="cart"),
        DeclareLaunchArgument(name="gui", default_value="true"),
        DeclareLaunchArgument("use_gui", default_value="true"),  # <!-- expect: L101 -->
        Node(package="cart_description", executable="cart", name=[model, speed, height, gui, *node]),
    ])
