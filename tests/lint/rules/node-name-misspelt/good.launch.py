from launch import LaunchDescription
from launch_ros.actions import Node

SERVERS = [
    "planner_server",
    "amcl",
]


def generate_launch_description():
    planner = Node(package="nav2_planner", executable="planner_server", name="planner_server")
    localizer = Node(package="nav2_amcl", executable="amcl", name="amcl")
    parameters = [{"node_names": SERVERS}]
    manager = Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", parameters=parameters)
    return LaunchDescription([planner, localizer, manager])
