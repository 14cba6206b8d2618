import launch
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    gui = DeclareLaunchArgument("gui", default_value="true")
    speed = LaunchConfiguration("speed")  # <!-- expect: L107 -->
    use_sim_time = LaunchConfiguration("use_sim_time")
    driver = Node(package="joy", executable="joy_node", parameters=["joy.yaml"])  # <!-- expect: L107 -->
    spawner: Node = Node(package="controller_manager", executable="spawner", arguments=["a"])
    other = Node(package="controller_manager", executable="spawner", arguments=["a"])
    handler = RegisterEventHandler(OnProcessExit(target_action=spawner, on_exit=[other]))
    shell = launch.actions.ExecuteProcess(cmd=["ls"])
    arguments = [DeclareLaunchArgument("speed"), DeclareLaunchArgument("use_sim_time")]
    return LaunchDescription([driver, handler, *arguments])  # <!-- expect: L107, L107, L107 -->
