from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder


def generate_launch_description():
    moveit = MoveItConfigsBuilder("cart").to_moveit_configs()
    moveit.moveit_cpp.update({"use_sim_time": True})
    clock = {"use_sim_time": True}
    rviz = Node(package="rviz2", executable="rviz2", parameters=[moveit.robot_description, clock])
    move = Node(
        package="moveit_ros_move_group",
        executable="move_group",
        parameters=[moveit.to_dict()],
    )
    return LaunchDescription([rviz, move])
