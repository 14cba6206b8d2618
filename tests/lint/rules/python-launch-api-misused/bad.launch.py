import launch
from lauch.actions import GroupAction  # <!-- expect: L106 -->
from launch import LaunchDescription
from launch.action import DeclareLaunchArgument  # <!-- expect: L106 -->
from launch.actions import LaunchConfiguration  # <!-- expect: L106 -->
from launch.parameter_descriptions import ParameterValue  # <!-- expect: L106 -->
from launch_ros.actions import Node, SetParametr  # <!-- expect: L106 -->


def generate_launch_description():
    simulated = {"use_sim_time": True}
    return LaunchDescription([
        DeclareLaunchArgument("gui", default_vlaue="true"),  # <!-- expect: L106 -->
        Node(
            pkg="rviz2",  # <!-- expect: L106 -->
            executable="rviz2",
            arguments="-d x.rviz",  # <!-- expect: L106 -->
            parameters={"gui": ParameterValue(LaunchConfiguration("gui"))},  # <!-- expect: L106 -->
        ),
        Node(package="rviz2", executable="rviz2", parameters=simulated),  # <!-- expect: L106 -->
        launch.actions.ExecuteProcess(cmd="ls", outputs="screen"),  # <!-- expect: L106, L106 -->
        GroupAction([]),
        launch.actions.DeclareLaunchArgument("paused", default_value=False),  # <!-- expect: L106 -->
        launch.actions.IncludeLaunchDescription("z.launch.py", condition=LaunchConfiguration("gui")),  # <!-- expect: L106 -->
        launch.actions.IncludeLaunchDescription("z.launch.py", launch_arguments={"gui": True}.items()),  # <!-- expect: L106 -->
        launch.actions.IncludeLaunchDescription("x.launch.py", launch_arguments={"gui": "1"}.items),  # <!-- expect: L106 -->
        launch.actions.IncludeLaunchDescription("y.launch.py", launch_arguments={"gui": "1"}),  # <!-- expect: L106 -->
    ])
