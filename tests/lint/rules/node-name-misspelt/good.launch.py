from launch import LaunchDescription
from launch_ros.actions import Node

SERVERS = ["planner_server"]


def generate_launch_description():
    planner = Node(package="nav2_planner", executable="planner_server", name="planner_server")
    parameters = [{"node_names": SERVERS}]
    manager = Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", parameters=parameters)
    return LaunchDescription([planner, manager])
