from launch import LaunchDescription
from launch_ros.actions import Node

SERVERS = [
    "planer_server",  # <!-- expect: L117 -->
    "amcl_node",  # <!-- expect: L117 -->
    "map_server",
    "bt_navigator",
    "smoother_server",  # <!-- expect: L117 -->
]


def generate_launch_description():
    planner = Node(package="nav2_planner", executable="planner_server", name="planner_server")
    localizer = Node(package="nav2_amcl", executable="amcl", name="amcl")
    maps = Node(package="nav2_map_server", executable="map_server", name="map_server", parameters=["map.yaml"])
    behaviors = Node(package="nav2_behaviors", executable="behavior_server")
    navigator = Node(package="nav2_bt_navigator", executable="bt_navigator", name="bt_navigator")
    parameters = [{"node_names": SERVERS}]
    manager = Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", parameters=parameters)
    return LaunchDescription([planner, localizer, maps, behaviors, navigator, manager])
