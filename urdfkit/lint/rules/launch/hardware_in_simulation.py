"""L127 hardware-in-simulation."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class HardwareInSimulation(RobotRule):
    """A launch file starts the drivers of the hardware in the simulation only, or Gazebo without it only.

    ## What it does
    Checks the conditions of nodes and includes that depend on an argument such as ``use_sim`` or ``sim_mode``: a launch
    file or node with drivers of sensors or ``ros2_control_node`` must not have the condition that the robot is
    simulated, and Gazebo must not have the condition that it is not. Included files with both are not checked.

    ## Why is this bad?
    The condition is inverted: drivers start without their devices, and the robot starts without its drivers.

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
    name = "hardware-in-simulation"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each inverted condition."""
        from urdfkit.lint.facts.nodes.simulated_hardware import inverted_conditions

        for source, place, message in inverted_conditions(model):
            yield self.at_span(source.span(*place), message)
