from launch import LaunchDescription
from launch.actions import ExecuteProcess, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("cart_description"), "cart.urdf"])
    prefix = LaunchConfiguration("prefix", default="")
    descriptions = [
        Command(["xacro", path]),  # <!-- expect: L108 -->
        Command([PathJoinSubstitution([FindExecutable(name="xacro")]), path]),  # <!-- expect: L108 -->
        Command(["xacro ", path, "" "prefix:=", prefix]),  # <!-- expect: L102, L108 -->
        Command(["xacro ", path, " prefix:=", prefix, "size:=2"]),  # <!-- expect: L102, L102, L108 -->
    ]
    arguments = {"gz_args": ["-r -v 4", path]}.items()  # <!-- expect: L108 -->
    return LaunchDescription([
        IncludeLaunchDescription(PythonLaunchDescriptionSource(prefix), launch_arguments=arguments),
        Node(package="rviz2", executable="rviz2", arguments=["-d" "cart.rviz"]),  # <!-- expect: L108 -->
        Node(package="rviz2", executable="rviz2", arguments=["-d cart.rviz"]),  # <!-- expect: L108 -->
        ExecuteProcess(
            cmd=[
                "ros2",
                "bag"  # <!-- expect: L108 -->
                "--all",
                *descriptions,
            ]
        ),
    ])
