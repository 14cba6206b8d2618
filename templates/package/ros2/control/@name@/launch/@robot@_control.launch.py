"""Start the controllers after the robot is in Gazebo: ros2 launch @name@ @robot@_control.launch.py."""

from launch import LaunchDescription
from launch_ros.actions import Node

CONTROLLERS = ["joint_state_broadcaster@spawned@"]


def generate_launch_description():
    """Spawn the controllers; each spawner waits for the controller manager, which Gazebo runs."""
    return LaunchDescription([
        Node(package="controller_manager", executable="spawner", arguments=[controller]) for controller in CONTROLLERS
    ])
