from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

MOVED = [("odometry/filtered", "odometry/map")]


def generate_launch_description():
    config = PathJoinSubstitution([FindPackageShare("cart_description"), "config", "local.yaml"])
    name = "robot_localization"
    return LaunchDescription([
        Node(package=name, executable="ekf_node", name="ekf_odom", parameters=[config]),
        Node(package=name, executable="ekf_node", name="ekf_map", parameters=[config], remappings=MOVED),
    ])
