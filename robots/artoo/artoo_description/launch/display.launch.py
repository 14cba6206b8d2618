"""View the robot in RViz and move its joints with sliders: ros2 launch artoo_description display.launch.py."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition, UnlessCondition
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Start robot_state_publisher, sliders for the joints, and RViz."""
    share = FindPackageShare("artoo_description")
    model = PathJoinSubstitution([share, "urdf", "artoo.urdf.xacro"])
    rviz_config = PathJoinSubstitution([share, "rviz", "artoo.rviz"])
    gui = LaunchConfiguration("gui")
    return LaunchDescription(
        [
            DeclareLaunchArgument("gui", default_value="true", description="Sliders for the joints."),
            DeclareLaunchArgument("rviz", default_value="true", description="Open RViz."),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[{"robot_description": ParameterValue(Command(["xacro ", model]), value_type=str)}],
            ),
            Node(
                package="joint_state_publisher_gui",
                executable="joint_state_publisher_gui",
                condition=IfCondition(gui),
            ),
            Node(
                package="joint_state_publisher",
                executable="joint_state_publisher",
                condition=UnlessCondition(gui),
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                arguments=["-d", rviz_config],
                condition=IfCondition(LaunchConfiguration("rviz")),
            ),
        ]
    )
