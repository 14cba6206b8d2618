from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    return LaunchDescription([
        IncludeLaunchDescription([FindPackageShare("ros_gz_sim"), "/launch/gz_sim.launch.py"], launch_arguments={"gz_args": "-r empty.sdf"}.items()),  # <!-- expect: L104 -->
        Node(package="ros_gz_bridge", executable="parameter_bridge", parameters=[{"config_file": "/tmp/bridge.yaml"}]),  # <!-- expect: L104 -->
    ])
