from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

SERVERS = ["planner_server"]  # <!-- expect: L117 -->


def generate_launch_description():
    filters = PathJoinSubstitution([FindPackageShare("cart_localization"), "launch", "filters.launch.py"])
    planner = Node(package="nav2_planner", executable="planner_server", name="planner_server")
    behaviors = Node(package="nav2_behaviors", executable="behavior_server")
    parameters = [{"node_names": SERVERS}]
    manager = Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", parameters=parameters)
    include = IncludeLaunchDescription(PythonLaunchDescriptionSource(filters))
    return LaunchDescription([include, planner, behaviors, manager])
