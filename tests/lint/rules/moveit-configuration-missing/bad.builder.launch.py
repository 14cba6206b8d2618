from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder


def generate_launch_description():
    cart = MoveItConfigsBuilder("cart", package_name="cart_description").robot_description()
    settings = [cart.robot_description, cart.joint_limits]  # <!-- expect: M111 -->
    return LaunchDescription([Node(package="moveit_ros_move_group", executable="move_group", parameters=settings)])
