from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare

MOVED = [("odometry/filtered", "odometry/map")]


def generate_launch_description():
    share = FindPackageShare("cart_description")
    config = PathJoinSubstitution([share, "config", "ekf.yaml"])
    path = PathJoinSubstitution([FindPackageShare("gazebo_ros"), "launch", "gazebo.launch.py"])
    own = PathJoinSubstitution([share, "launch", "own.launch.py"])
    clock = {"use_sim_time": True}
    name = "robot_localization"
    return LaunchDescription([
        Node(package=name, executable="ekf_node", name="odom", parameters=[config, clock]),
        Node(package=name, executable="ekf_node", name="map", parameters=[config], remappings=MOVED),  # <!-- expect: L121 -->
        Node(package="nav2_controller", executable="controller_server", parameters=[clock]),
        Node(package="nav2_planner", executable="planner_server"),  # <!-- expect: L121 -->
    ])
