import launch
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    gui = launch.substitutions.LaunchConfiguration("gui")  # <!-- expect: L101 -->
    condition = launch.conditions.IfCondition("gui")  # <!-- expect: L106 -->
    description = launch.substitutions.Command(["cat ", "cart.urdf"])
    server = Node(
        package="rviz2",
        executable="rviz2",
        condition=condition,
        parameters=[description],  # <!-- expect: L106 -->
        remappings=["/joint_states", "/cart/joint_states"],  # <!-- expect: L106 -->
        arguments=["-x", -0.5],  # <!-- expect: L106 -->
    )
    other = Node(
        package="rviz2",
        executable="rviz2",
        parameters=[{"use_sim_time", True}],  # <!-- expect: L106 -->
        arguments=gui,  # <!-- expect: L106 -->
    )
    handler = launch.event_handlers.OnProcessExit(
        target_action="server",  # <!-- expect: L106 -->
        on_exit=["other"],  # <!-- expect: L106 -->
    )
    loop = launch.event_handlers.OnProcessExit(target_action=other, on_exit=[other])  # <!-- expect: L106 -->
    list_of_one = launch.event_handlers.OnProcessExit(target_action=[server], on_exit=[other])  # <!-- expect: L106 -->
    timer = launch.actions.TimerAction(period=2.0, actions=server)  # <!-- expect: L106 -->
    late = launch.event_handlers.OnProcessStart(target_action=timer, on_start=[other])  # <!-- expect: L106 -->
    if gui == "true":  # <!-- expect: L106 -->
        return LaunchDescription(server)  # <!-- expect: L106 -->
    if gui:  # <!-- expect: L106 -->
        return LaunchDescription([server, other], [timer, handler, loop, list_of_one, late])  # <!-- expect: L106 -->
    node = Node(package="rviz2", executable="rviz2", parameters=[moveit().to_moveit_configs()])  # <!-- expect: L106 -->
    return LaunchDescription([node])


def moveit():
    return None
