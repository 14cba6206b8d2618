"""Start all parts of the robot: ros2 launch @name@_bringup @name@.launch.py."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Start Gazebo with the robot and, if requested, RViz."""
    gazebo = FindPackageShare("@name@_gazebo")
    rviz_config = PathJoinSubstitution([FindPackageShare("@name@_description"), "rviz", "@name@.rviz"])
    return LaunchDescription([
        DeclareLaunchArgument("world", default_value=PathJoinSubstitution([gazebo, "worlds", "@world_file@"])),
        DeclareLaunchArgument("rviz", default_value="false", description="Open RViz."),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(PathJoinSubstitution([gazebo, "launch", "@name@.launch.py"])),
            launch_arguments={"world": LaunchConfiguration("world")}.items(),
        ),
        Node(
            package="rviz2",
            executable="rviz2",
            arguments=["-d", rviz_config],
            parameters=[{"use_sim_time": True}],
            condition=IfCondition(LaunchConfiguration("rviz")),
        ),
    ])
