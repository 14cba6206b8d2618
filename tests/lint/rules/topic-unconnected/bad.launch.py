from launch import LaunchDescription
from launch_ros.actions import Node

REMAPPINGS = [
    ("imu/data", "imu/data"),  # <!-- expect: K980 -->
    ("gps/fix", "fix"),
]


def generate_launch_description():
    smoothed = [("smoothed_cmd_vel", "cmd_vel")]  # <!-- expect: K980 -->
    velocities = [("/drive/cmd_vel", "cmd_vel")]  # <!-- expect: K980 -->
    return LaunchDescription([
        Node(package="robot_localization", executable="navsat_transform_node", remappings=REMAPPINGS),
        Node(package="nav2_velocity_smoother", executable="velocity_smoother", remappings=smoothed),
        Node(package="teleop_twist_joy", executable="teleop_node", remappings=velocities),
    ])
