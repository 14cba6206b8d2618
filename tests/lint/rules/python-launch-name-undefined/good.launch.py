import os.path

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction


def actions(context, *args, **kwargs):
    return [print(name, args, kwargs, os.path.basename(__file__)) for name in context.launch_configurations]


def generate_launch_description():
    gui = DeclareLaunchArgument("gui", default_value="true")
    return LaunchDescription([gui, OpaqueFunction(function=actions)])
