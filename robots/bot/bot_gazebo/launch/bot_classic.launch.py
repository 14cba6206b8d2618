"""Start Gazebo Classic with the robot: ros2 launch bot_gazebo bot_classic.launch.py.

Then drive it: ros2 run teleop_twist_keyboard teleop_twist_keyboard --ros-args -r cmd_vel:=/robot_0/cmd_vel
"""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    """Start Gazebo Classic, spawn the robot, and publish its frames."""
    gazebo = FindPackageShare("bot_gazebo")
    model = PathJoinSubstitution([FindPackageShare("bot_description"), "urdf", "bot.urdf.xacro"])
    description = ParameterValue(Command(["xacro ", model, " gazebo:=classic"]), value_type=str)
    return LaunchDescription(
        [
            DeclareLaunchArgument("world", default_value=PathJoinSubstitution([gazebo, "worlds", "rooms.world"])),
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
                remappings=[("joint_states", "/robot_0/joint_states")],
                parameters=[{"use_sim_time": True, "robot_description": description}],
            ),
            Node(
                package="gazebo_ros",
                executable="spawn_entity.py",
                arguments=[
                    "-entity",
                    "robot_0",
                    "-topic",
                    "robot_description",
                    "-x",
                    LaunchConfiguration("x"),
                    "-y",
                    LaunchConfiguration("y"),
                    "-Y",
                    LaunchConfiguration("yaw"),
                ],
                output="screen",
            ),
        ]
    )
