"""L122 exit-handler-never-runs."""

from __future__ import annotations

from urdfkit.lint.facts.control.launch_package_paths import place
from urdfkit.lint.rule import Findings, Model, RobotRule


class ExitHandlerNeverRuns(RobotRule):
    """A launch file starts nodes after the exit of a node that never exits.

    ## What it does
    Checks for ``OnProcessExit`` handlers that start nodes although their target runs until the launch ends, such as
    ``ros2_control_node`` or ``robot_state_publisher``.

    ## Why is this bad?
    The nodes of the handler, such as the spawners of controllers, never start, and launch reports no error.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch.actions import RegisterEventHandler
    -from launch.event_handlers import OnProcessExit
    +from launch.event_handlers import OnProcessStart
     from launch_ros.actions import Node


     def generate_launch_description():
         manager = Node(package="controller_manager", executable="ros2_control_node", parameters=["controllers.yaml"])
         arm = Node(package="controller_manager", executable="spawner", arguments=["arm_controller"])
    -    handler = RegisterEventHandler(OnProcessExit(target_action=manager, on_exit=[arm]))
    +    handler = RegisterEventHandler(OnProcessStart(target_action=manager, on_start=[arm]))
         return LaunchDescription([manager, handler])
    ```
    """

    code = "L122"
    name = "exit-handler-never-runs"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each handler that waits for a node without an end."""
        from urdfkit.lint.facts.launch.python.names import python_files
        from urdfkit.lint.facts.nodes.exit_handlers import never_run, never_started

        for source, tree in python_files(model):
            for target, name, before in never_started(tree) if "OnProcess" in source.text else ():
                message = f"`{name}` starts after `{before}`, which waits for `{name}`: neither of them starts"
                yield self.at_span(source.span(*place(source, target)), message)
            for at, program in never_run(source, tree) if "OnProcessExit" in source.text else ():
                message = f"`{program}` runs until the launch ends, so `on_exit` starts nothing"
                help = "name the process that exits before the nodes start, or use OnProcessStart"
                yield self.at_span(source.span(*at), message, help=help)
