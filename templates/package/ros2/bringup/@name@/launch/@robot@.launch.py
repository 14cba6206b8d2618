"""Start all parts of the robot: ros2 launch @name@ @robot@.launch.py."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import IfCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Start Gazebo with the robot and, if requested, RViz."""
    gazebo = FindPackageShare("@gazebo@")
    rviz_config = PathJoinSubstitution([FindPackageShare("@description@"), "rviz", "@robot@.rviz"])
    return LaunchDescription([
        DeclareLaunchArgument("world", default_value=PathJoinSubstitution([gazebo, "worlds", "empty.sdf"])),
        DeclareLaunchArgument("rviz", default_value="false", description="Open RViz."),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(PathJoinSubstitution([gazebo, "launch", "@robot@.launch.py"])),
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
