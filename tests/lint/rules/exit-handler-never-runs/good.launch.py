from launch import LaunchDescription
from launch.actions import LogInfo, RegisterEventHandler, Shutdown
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node

MANAGER = "controller_manager"


def generate_launch_description():
    state = Node(package="robot_state_publisher", executable="robot_state_publisher", parameters=["state.yaml"])
    manager = Node(package=MANAGER, executable="ros2_control_node", parameters=["controllers.yaml"])

    def spawner(name):
        return Node(package=MANAGER, executable="spawner", arguments=[name])

    broadcaster = spawner("joint_state_broadcaster")
    arm = spawner("arm_controller")
    return LaunchDescription([
        state,
        manager,
        broadcaster,
        RegisterEventHandler(OnProcessExit(target_action=broadcaster, on_exit=[arm])),
        RegisterEventHandler(OnProcessExit(target_action=manager, on_exit=[Shutdown()])),
        RegisterEventHandler(OnProcessExit(target_action=state, on_exit=[LogInfo(msg="the state is lost")])),
    ])
