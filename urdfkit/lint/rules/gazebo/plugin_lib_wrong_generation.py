"""Z807 plugin-lib-wrong-generation."""

from urdfkit.lint.facts.gazebo.plugins import allowed, is_foreign, plugins, specs
from urdfkit.lint.rule import Findings, Model, RobotRule


class PluginLibWrongGeneration(RobotRule):
    """A plugin library does not exist for the target.

    ## What it does
    Checks for libraries of Gazebo Classic (``libgazebo_ros_….so``) with ``--target gz``, for systems of Gazebo Sim
    (``gz-sim-…-system``) with ``classic`` and ``ros1``, and for libraries of only one ROS generation with ``ros1`` or
    ``ros2``. From Jazzy on (``ros2-jazzy``), ROS 2 has no Gazebo Classic.

    ## Why is this bad?
    Gazebo reports "Failed to load plugin", and the drive or sensor that the plugin provides is missing.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <gazebo>
    -    <plugin name="move" filename="libgazebo_ros_planar_move.so">
    -      <robotBaseFrame>base_footprint</robotBaseFrame>
    +    <plugin name="gz::sim::systems::VelocityControl" filename="gz-sim-velocity-control-system">
    +      <topic>cmd_vel</topic>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "Z807"
    name = "plugin-lib-wrong-generation"
    only_for = ("gz", "classic", "ros1", "ros2")

    def check(self, model: Model) -> Findings:
        """Yield a finding for each library of another generation."""
        from urdfkit.description.plugins import ALL_SPECS

        for plugin, _, _ in plugins(model.robot):
            if not is_foreign(plugin, model):
                continue
            kinds = {spec.kind for spec in specs(plugin)}
            replacements = {
                file
                for spec in ALL_SPECS
                if spec.kind in kinds and spec.generation in allowed(model)
                for file in spec.filenames
            }
            message = f"library `{(plugin.filename or '').strip()}` does not exist for {model.release or model.target}"
            help = f"use {min(replacements)}" if replacements else None
            yield self.at(model, plugin.element, message, attribute="filename", help=help)
