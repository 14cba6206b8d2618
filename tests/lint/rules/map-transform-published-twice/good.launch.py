from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.conditions import UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    gps = LaunchConfiguration("gps")
    filters = PathJoinSubstitution([FindPackageShare("cart_description"), "launch", "filters.launch.py"])
    slam = PathJoinSubstitution([FindPackageShare("slam_toolbox"), "launch", "online_async_launch.py"])
    return LaunchDescription([
        DeclareLaunchArgument("gps", default_value="true"),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(filters), launch_arguments={"use_gps": gps}.items()
        ),
        IncludeLaunchDescription(
            PythonLaunchDescriptionSource(slam), condition=UnlessCondition(gps)
        ),
    ])
