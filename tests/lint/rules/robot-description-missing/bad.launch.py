from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    simulated = {"use_sim_time": True}
    control = Node(package="controller_manager", executable="ros2_control_node")  # <!-- expect: L112 -->
    return LaunchDescription([
        control,
        Node(package="robot_state_publisher", executable="robot_state_publisher"),  # <!-- expect: L113, L121 -->
        Node(  # <!-- expect: L113 -->
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[simulated, {"publish_frequency": 50.0}],
        ),
    ])
