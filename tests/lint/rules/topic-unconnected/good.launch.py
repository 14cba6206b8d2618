from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

REMAPPINGS = [("imu", "imu/data"), ("/gps/fix", "fix"), ("/tf", "tf")]


def generate_launch_description():
    config = PathJoinSubstitution([FindPackageShare("cart_description"), "ekf.yaml"])
    odometry = [("wheels/odom", "odom"), ("odometry/filtered", "odometry")]
    smoothed = [("cmd_vel", "cmd_vel_auto"), ("cmd_vel_smoothed", "cmd_vel")]
    return LaunchDescription([
        Node(package="robot_localization", executable="navsat_transform_node", remappings=REMAPPINGS),
        Node(package="robot_localization", executable="ekf_node", parameters=[config], remappings=odometry),
        Node(package="nav2_velocity_smoother", executable="velocity_smoother", remappings=smoothed),
    ])
