from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    slam = PathJoinSubstitution([FindPackageShare("slam_toolbox"), "launch", "online_async_launch.py"])  # <!-- expect: K956 -->
    return LaunchDescription([
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(slam),
            launch_arguments={"params_file": "slam.yaml"}.items(),  # <!-- expect: L102 -->
        )
    ])
