"""Start Gazebo with the robot: ros2 launch @name@_gazebo @name@.launch.py."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Start Gazebo, spawn the robot, and publish its frames."""
    gazebo = FindPackageShare("@name@_gazebo")
    model = PathJoinSubstitution([FindPackageShare("@name@_description"), "urdf", "@name@.urdf.xacro"])
    control = FindPackageShare("@name@_@control@")
    simulated = {"use_sim_time": True}
    return LaunchDescription([
        DeclareLaunchArgument("world", default_value=PathJoinSubstitution([gazebo, "worlds", "empty.world"])),
        DeclareLaunchArgument("x", default_value="0"),
        DeclareLaunchArgument("y", default_value="0"),
        DeclareLaunchArgument("yaw", default_value="0"),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                PathJoinSubstitution([FindPackageShare("gazebo_ros"), "launch", "gazebo.launch.py"])
            ),
            launch_arguments={"world": LaunchConfiguration("world")}.items(),
        ),
        Node(
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[
                simulated,
                {"robot_description": ParameterValue(Command(["xacro ", model]), value_type=str)},
            ],
        ),
        Node(
            package="gazebo_ros",
            executable="spawn_entity.py",
            arguments=[
                "-entity", "@name@",
                "-topic", "robot_description",
                "-x", LaunchConfiguration("x"),
                "-y", LaunchConfiguration("y"),
                "-Y", LaunchConfiguration("yaw"),
            ],
            parameters=[simulated],
            output="screen",
        ),
        IncludeLaunchDescription(PathJoinSubstitution([control, "launch", "@name@_@control@.launch.py"])),
    ])
