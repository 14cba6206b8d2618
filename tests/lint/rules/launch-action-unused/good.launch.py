from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node


def generate_launch_description():
    gui = DeclareLaunchArgument("gui", default_value="true")
    spawner = Node(package="controller_manager", executable="spawner", arguments=["arm"])
    other = Node(package="controller_manager", executable="spawner", arguments=["arm"])
    handler = RegisterEventHandler(OnProcessExit(target_action=spawner, on_exit=[other]))
    use_sim_time = LaunchConfiguration("use_sim_time")
    speed = LaunchConfiguration("speed")
    again = {"speed": LaunchConfiguration("speed"), "use_sim_time": use_sim_time}
    rviz = Node(package="rviz2", executable="rviz2")
    node = Node(package="joy", executable="joy_node", parameters=[again])
    node = [node, Node(package="joy", executable="joy_node")]
    description = LaunchDescription(
        [DeclareLaunchArgument("speed"), DeclareLaunchArgument("use_sim_time"), handler, spawner]
    )
    description.add_action(gui)
    # description.add_action(rviz)
    return description
