"""L126 node-arguments-missing."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class NodeArgumentsMissing(RobotRule):
    """A node that needs arguments is started without them.

    ## What it does
    Checks launch files for programs that stop without arguments:

    - in ROS 1, ``map_server``, ``spawn_model``, the spawner of controllers, ``rosbag play``,
      ``static_transform_publisher`` and the programs of ``topic_tools``
    - in ROS 2, the spawner of controllers and ``spawn_entity.py``; ``parameter_bridge`` and ``create`` without
      parameters; ``map_server`` without ``yaml_filename``; and ``move_group`` without a planning pipeline

    Gazebo without ``-r`` starts paused. It is reported if it has no window or if spawners of controllers wait for it.
    Also reports a lifecycle manager whose ``autostart`` is false, if no file calls its service.

    ## Why is this bad?
    The node prints its usage message and exits, or waits without effect.

    ## Example
    ```diff title="robot.launch.py"
     from launch import LaunchDescription
     from launch_ros.actions import Node


     def generate_launch_description():
    -    return LaunchDescription([Node(package="controller_manager", executable="spawner")])
    +    return LaunchDescription([Node(package="controller_manager", executable="spawner", arguments=["drive"])])
    ```
    """

    code = "L126"
    name = "node-arguments-missing"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each node without the arguments that it needs."""
        from urdfkit.lint.facts.nodes.needed_arguments import idle_managers, nodes_without_arguments, paused_simulations
        from urdfkit.lint.facts.nodes.unloaded_sections import maps_without_file

        for source, place, message in (*idle_managers(model), *paused_simulations(model)):
            yield self.at_span(source.span(*place), message, severity="warning")
        for source, place, message in maps_without_file(model):
            yield self.at_span(source.span(*place), message)
        for source, place, message, names in nodes_without_arguments(model):
            yield self.at_span(source.span(*place), message, names=names)
