from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
    passed = {"world": "empty.sdf", "on_exit_shutdown": "true"}.items()  # <!-- expect: L102 -->
    return LaunchDescription([IncludeLaunchDescription(PythonLaunchDescriptionSource(path), launch_arguments=passed)])
