from launch import LaunchDescription
from launch.substitutions import Command, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("cart_description"), "urdf", "cart.urdf.xacro"])
    description = {"robot_description": Command(["xacro ", path, " length:=", "2", " prefix:=a=b"])}
    state = Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description])
    return LaunchDescription([state])
