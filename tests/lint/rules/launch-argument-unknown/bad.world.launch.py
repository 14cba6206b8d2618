from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
    passed = {"world": "empty.sdf", "on_exit_shutdown": "true"}.items()  # <!-- expect: L102 -->
    classic = PathJoinSubstitution([FindPackageShare("gazebo_ros"), "launch", "gzserver.launch.py"])
    server = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(classic),
        launch_arguments={
            "world_name": "empty.world",  # <!-- expect: L102 -->
            "headless": "true",  # <!-- expect: L102 -->
            "use_sim_time": "true",
        }.items(),
    )
    simulation = IncludeLaunchDescription(PythonLaunchDescriptionSource(path), launch_arguments=passed)
    return LaunchDescription([simulation, server])
