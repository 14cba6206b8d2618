"""Start Gazebo with the robot: ros2 launch gem_e2_gazebo gem_e2.launch.py.

Then drive it: ros2 run teleop_twist_keyboard teleop_twist_keyboard --ros-args -r cmd_vel:=/twist_to_ackermann
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Start Gazebo, spawn the robot, bridge its topics, and publish its frames."""
    gazebo = FindPackageShare("gem_e2_gazebo")
    model = PathJoinSubstitution([FindPackageShare("gem_e2_description"), "urdf", "gem_e2.urdf.xacro"])
    xacro = Command(["xacro ", model, " gazebo:=gz velodyne:=", LaunchConfiguration("velodyne")])
    simulated = {"use_sim_time": True}
    return LaunchDescription(
        [
            DeclareLaunchArgument("world", default_value=PathJoinSubstitution([gazebo, "worlds", "empty.sdf"])),
            DeclareLaunchArgument("velodyne", default_value="true", description="The lidar on the roof."),
            DeclareLaunchArgument("x", default_value="0"),
            DeclareLaunchArgument("y", default_value="0"),
            DeclareLaunchArgument("yaw", default_value="0"),
            IncludeLaunchDescription(
                PythonLaunchDescriptionSource(
                    PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
                ),
                launch_arguments={"gz_args": ["-r ", LaunchConfiguration("world")]}.items(),
            ),
            Node(
                package="robot_state_publisher",
                executable="robot_state_publisher",
                parameters=[
                    simulated,
                    {"robot_description": ParameterValue(xacro, value_type=str)},
                ],
            ),
            Node(
                package="ros_gz_sim",
                executable="create",
                arguments=[
                    "-name",
                    "gem_e2",
                    "-topic",
                    "robot_description",
                    "-x",
                    LaunchConfiguration("x"),
                    "-y",
                    LaunchConfiguration("y"),
                    "-Y",
                    LaunchConfiguration("yaw"),
                ],
                parameters=[simulated],
                output="screen",
            ),
            Node(
                package="ros_gz_bridge",
                executable="parameter_bridge",
                parameters=[simulated, {"config_file": PathJoinSubstitution([gazebo, "config", "bridge.yaml"])}],
                output="screen",
            ),
        ]
    )
