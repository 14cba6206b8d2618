"""L117 node-name-misspelt."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class NodeNameMisspelt(RobotRule):
    """The name of a node differs between a launch file and its parameters.

    ## What it does
    Compares the names of nodes in ROS 2 launch files with the sections of the parameter files that these nodes load,
    and with the ``node_names`` of lifecycle managers. Reports names that differ by one letter. Also reports parameter
    files without a section for the node that loads them, if another file has this section. Files with ``/**`` are not
    checked, because their parameters apply to every node. Also reports nodes whose only section is in another
    namespace; the comparison includes the namespaces of groups and includes. In ROS 1, the rule reports nodelets whose
    manager has another name.

    ## Why is this bad?
    The node starts without its parameters and without an error. A lifecycle manager waits for a node that never
    starts.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch_ros.actions import Node

    -SERVERS = ["planer_server"]
    +SERVERS = ["planner_server"]


     def generate_launch_description():
         planner = Node(package="nav2_planner", executable="planner_server", name="planner_server")
         parameters = [{"node_names": SERVERS}]
         manager = Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", parameters=parameters)
         return LaunchDescription([planner, manager])
    ```

    ## Fix safety
    Unsafe: the fix replaces a misspelt name with the nearest known name, which may not be the intended one.
    """

    code = "L117"
    name = "node-name-misspelt"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each name without its counterpart."""
        from urdfkit.lint.facts.connections.parameter_sections import sections_elsewhere
        from urdfkit.lint.facts.nodes.names import misnamed
        from urdfkit.lint.facts.nodes.nodelets import unmanaged_nodelets
        from urdfkit.lint.facts.nodes.unloaded_sections import nodes_without_section

        for source, place, message in nodes_without_section(model):
            yield self.at_span(source.span(*place), message)
        for _, span, message in misnamed(model):
            yield self.at_span(span, message)
        for span, message in sections_elsewhere(model):
            yield self.at_span(span, message, kind="namespace")
        for source, manager, message in unmanaged_nodelets(model):
            start = manager.end - len(manager.name.rpartition("/")[2])
            yield self.at_span(source.span(start, manager.end), message)
