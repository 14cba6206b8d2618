from launch import LaunchDescription
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def node(**options):
    return Node(package="robot_state_publisher", executable="robot_state_publisher", **options)


def generate_launch_description():
    description = {"use_sim_time": True}
    description["robot_description"] = "<robot name='cart'/>"
    return LaunchDescription([
        node(parameters=[description]),
        Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=[description]),
        Node(package="robot_state_publisher", executable="robot_state_publisher", arguments=["cart.urdf"], parameters=[description]),
        Node(
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[{"use_sim_time": True}, LaunchConfiguration("params_file", default="")],
        ),
    ])
