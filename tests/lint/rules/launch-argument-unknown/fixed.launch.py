import os

from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = get_package_share_directory("cart_description")
    path = os.path.join(share, "urdf", "cart.urdf.xacro")
    passed = {"gz_args": "-r"}.items()  # <!-- expect: L102 -->
    return LaunchDescription([
        Command(["xacro ", path, " length:=", "2"]),  # <!-- expect: L102 -->
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(
                PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
            ),
            launch_arguments=passed,
        ),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource([get_package_share_directory("cart_description"), "/launch/inner.launch.py"]),
            launch_arguments={"world": "empty", "gui": "false", "name": "cart"}.items(),  # <!-- expect: L102 -->
        ),
        IncludeLaunchDescription(  # <!-- expect: L102 -->
            PythonLaunchDescriptionSource(f"{share}/launch/inner.launch.py")
        ),
    ])
