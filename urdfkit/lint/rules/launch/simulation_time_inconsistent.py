"""L121 simulation-time-inconsistent."""

from __future__ import annotations

from urdfkit.lint.rule import Findings, Model, RobotRule


class SimulationTimeInconsistent(RobotRule):
    """A node and the other nodes of its launch file use different clocks.

    ## What it does
    Checks ROS 2 launch files. Reports:

    - filters, localization, navigation servers and ``robot_state_publisher`` without ``use_sim_time``, if another node
      of the same package in the file sets this parameter
    - filters, localization, navigation servers, ``move_group`` and servo nodes without ``use_sim_time``, if
      ``robot_state_publisher`` or RViz sets it
    - in files that always start Gazebo, such nodes and included launch files that set ``use_sim_time`` to false
    - in these files, includes that do not pass ``use_sim_time``, if its default is false and another include passes it

    Parameter files are read too. Launch files that set the parameter for all nodes are not checked.

    ## Why is this bad?
    The node compares simulation time with system time, so it waits for transforms, or drops every message as too old.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch_ros.actions import Node


     def generate_launch_description():
         clock = {"use_sim_time": True}
         odom = Node(package="robot_localization", executable="ekf_node", name="ekf_odom", parameters=[clock])
    -    map = Node(package="robot_localization", executable="ukf_node", name="ukf_map")
    +    map = Node(package="robot_localization", executable="ukf_node", name="ukf_map", parameters=[clock])
         return LaunchDescription([odom, map])
    ```
    """

    code = "L121"
    name = "simulation-time-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each node with another clock."""
        from urdfkit.lint.facts.nodes import simulation_time as times

        kinds = (
            *(times.without_clock, times.computer_time, times.time_without_simulation),
            times.included_without_clock,
        )
        for source, place, message in (each for defects in kinds for each in defects(model)):
            yield self.at_span(source.span(*place), message)
