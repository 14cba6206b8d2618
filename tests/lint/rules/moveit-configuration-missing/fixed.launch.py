from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder


def generate_launch_description():
    first = MoveItConfigsBuilder("cart", package_name="cart_description").to_moveit_configs()  # <!-- expect: M111 -->
    second = MoveItConfigsBuilder("cart", package_name="cart_description").to_moveit_configs()  # <!-- expect: M111 -->
    settings = [first.to_dict(), second.to_dict()]
    return LaunchDescription([Node(package="moveit_ros_move_group", executable="move_group", parameters=settings)])
