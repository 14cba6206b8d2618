from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    x_pose = LaunchConfiguration("x_pose", default="0")
    y_pose = LaunchConfiguration("y_pose", default="0")
    return LaunchDescription(
        [
            DeclareLaunchArgument("x_pose", default_value="0"),
            SetLaunchConfiguration("robot", [x_pose, y_pose, LaunchConfiguration("robot")]),
        ]
    )
