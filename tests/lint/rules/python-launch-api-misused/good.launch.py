import launch
from launch import LaunchDescription, actions
from launch.action import Action
from launch.actions.declare_launch_argument import DeclareLaunchArgument
from launch.launch_description import LaunchDescription as Description
from launch_ros.actions import Node
from launch_ros.actions import SomethingOfRolling
from launch_ros.parameter_descriptions import ParameterValue
from cart_launch.actions import GroupAction

try:
    from launch.substitutions import FindPackageShare
except ImportError:
    from launch_ros.substitutions import FindPackageShare


class Own:
    def __init__(self, pkg):
        self.pkg = pkg


def generate_launch_description():
    options = {"arguments": ["-d", "x.rviz"]}
    share = FindPackageShare("cart_description")
    return LaunchDescription(
        [
            DeclareLaunchArgument("gui", default_value="true"),
            Node(package="rviz2", executable="rviz2", parameters=None, something_of_rolling=True, **options),
            launch.actions.ExecuteProcess(cmd=["ls", share], output="screen"),
            actions.LogInfo(msg=Own(pkg="rviz2").pkg),
            GroupAction(act=[Action(), Description(), SomethingOfRolling(), ParameterValue("x")]),
        ]
    )


def generate_values(context):
    gui = launch.substitutions.LaunchConfiguration("gui")
    server = Node(package="rviz2", executable="rviz2", remappings=[("a", "b")], arguments=["-x", "0.5", gui])
    other = Node(package="rviz2", executable="rviz2", parameters=[{"gui": gui}, "x.yaml", share_of("rviz2")])
    handler = launch.event_handlers.OnProcessExit(target_action=server, on_exit=other)
    always = launch.conditions.IfCondition("true")
    if gui.perform(context) == "true" and gui is not None:
        return LaunchDescription([server, launch.actions.GroupAction([other], condition=always)])
    return LaunchDescription([server, launch.actions.RegisterEventHandler(handler)])


def share_of(name):
    return FindPackageShare(name)
