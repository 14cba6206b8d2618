import launch
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node


def generate_launch_description():
    gui = DeclareLaunchArgument("gui", default_value="true")
    spawner: Node = Node(package="controller_manager", executable="spawner", arguments=["a"])
    other = Node(package="controller_manager", executable="spawner", arguments=["a"])
    handler = RegisterEventHandler(OnProcessExit(target_action=spawner, on_exit=[other]))
    shell = launch.actions.ExecuteProcess(cmd=["ls"])
    return LaunchDescription([handler])  # <!-- expect: L107, L107, L107 -->
