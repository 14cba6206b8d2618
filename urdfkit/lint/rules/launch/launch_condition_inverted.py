"""L127 launch-condition-inverted."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LaunchConditionInverted(RobotRule):
    """A launch file starts nodes under an inverted condition.

    ## What it does
    Checks the conditions of nodes and includes that depend on an argument such as ``use_sim`` or ``sim_mode``. Sensor
    drivers, ``ros2_control_node`` and launch files that start them must not be limited to the simulation, and Gazebo
    must not be limited to the real robot. Included files that start both are not checked.

    The name of an argument may state that it enables a node, include or group, as ``use_rviz`` enables ``rviz2``. The
    rule reports such an action if it starts when the argument is false, unless the file starts another such action when
    the argument is true. For arguments such as ``headless`` and ``disable_rviz``, the rule expects the reverse.

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
