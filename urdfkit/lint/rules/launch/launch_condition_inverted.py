"""L127 launch-condition-inverted."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchConditionInverted(RobotRule):
    """A launch file starts nodes under the opposite of their condition.

    ## What it does
    Checks the conditions of nodes and includes that depend on an argument such as ``use_sim`` or ``sim_mode``: a launch
    file or node with drivers of sensors or ``ros2_control_node`` must not have the condition that the robot is
    simulated, and Gazebo must not have the condition that it is not. Included files with both are not checked.

    A node, include or group that an argument names, such as ``rviz2`` or ``robot_moveit_config`` by ``use_rviz`` or
    ``moveit``, must not have the condition that the argument is false, unless the file starts another such action if
    it is true. The reverse holds for arguments such as ``headless`` and ``disable_rviz``.

    ## Why is this bad?
    Drivers start without their devices, the robot starts without its drivers, and the argument does the opposite of
    its name.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch.actions import DeclareLaunchArgument
    -from launch.conditions import IfCondition
    +from launch.conditions import UnlessCondition
     from launch.substitutions import LaunchConfiguration
     from launch_ros.actions import Node


     def generate_launch_description():
    -    condition = IfCondition(LaunchConfiguration("use_sim"))
    +    condition = UnlessCondition(LaunchConfiguration("use_sim"))
         lidar = Node(package="rplidar_ros", executable="rplidar_node", condition=condition)
         return LaunchDescription([DeclareLaunchArgument("use_sim", default_value="false"), lidar])
    ```
    """

    code = "L127"
    name = "launch-condition-inverted"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each inverted condition."""
        from urdfkit.lint.facts.nodes.inverted_conditions import inverted_conditions

        for source, place, message in inverted_conditions(model):
            yield self.at_span(source.span(*place), message)
