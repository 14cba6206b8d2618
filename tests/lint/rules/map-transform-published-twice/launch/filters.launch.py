from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    config = PathJoinSubstitution([FindPackageShare("cart_description"), "config", "ekf.yaml"])
    use_gps = IfCondition(LaunchConfiguration("use_gps"))
    return LaunchDescription([
        DeclareLaunchArgument("use_gps", default_value="true"),
        Node(package="robot_localization", executable="ekf_node", name="ekf_odom", parameters=[config]),
        Node(package="robot_localization", executable="ekf_node", name="ekf_map", parameters=[config], condition=use_gps),
    ])
