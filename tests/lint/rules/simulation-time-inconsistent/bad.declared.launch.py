from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = FindPackageShare("cart_description")
    world = PathJoinSubstitution([share, "launch", "world.launch.py"])
    clock = {"use_sim_time": False}  # <!-- expect: L121 -->
    return LaunchDescription([
        DeclareLaunchArgument("use_sim_time", default_value="false"),  # <!-- expect: L121 -->
        IncludeLaunchDescription(PythonLaunchDescriptionSource(world)),
        Node(package="robot_localization", executable="ekf_node", name="odom", parameters=[clock]),
        Node(
            package="robot_localization",
            executable="ekf_node",
            name="map",
            remappings=[("odometry/filtered", "odometry/map")],
            parameters=[{"use_sim_time": LaunchConfiguration("use_sim_time")}],
        ),
    ])
