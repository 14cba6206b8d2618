from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration


def generate_launch_description():
    return LaunchDescription(
        [
            DeclareLaunchArgument("world"),
            DeclareLaunchArgument("gui", default_value="true"),
            DeclareLaunchArgument("frame", default_value=LaunchConfiguration("name", default="cart")),
        ]
    )
