from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    def spawner(name):
        return Node(package="controller_manager", executable="spawner", arguments=[name, "-c", "/controller_manager"])

    arm = spawner("arm_controller")  # <!-- expect: K960 -->
    others = [
        Node(package="controller_manager", executable="spawner", arguments=[name])
        for name in ("arm_controller", "arm_controller")  # <!-- expect: K960 -->
    ]
    return LaunchDescription([arm, *others])
