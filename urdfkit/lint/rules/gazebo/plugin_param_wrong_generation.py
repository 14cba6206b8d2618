"""Z806 plugin-param-wrong-generation."""

from urdfkit.lint.facts.gazebo.plugins import plugins, spec_of, specs
from urdfkit.lint.fix_builders import new_tag
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_NAMES = {"ros1": "ROS 1", "ros2": "ROS 2", "gz": "Gazebo Sim"}


class PluginParamWrongGeneration(RobotRule):
    """A plugin parameter has the spelling of another generation of the plugin.

    ## What it does
    ROS 1 spells parameters in camelCase; ROS 2 and Gazebo Sim use snake_case. Some parameters have also changed their
    meaning. The rule reports parameters that only another generation of the plugin reads. The target determines the
    generation. Without a target, the rule assumes the generation that reads the largest number of the plugin's
    parameters.

    ## Why is this bad?
    The plugin ignores the parameter and uses its default, so its topics, frames and wheels differ from the description.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <gazebo>
         <plugin name="move" filename="libgazebo_ros_planar_move.so">
           <publish_odom>true</publish_odom>
    -      <odometryFrame>odom</odometryFrame>
    +      <odometry_frame>odom</odometry_frame>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix renames the parameter to its equivalent, which changes the behaviour of the robot.
    """

    code = "Z806"
    name = "plugin-param-wrong-generation"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter that only another generation reads."""
        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target)
            others = [other for other in specs(plugin) if other is not spec]
            if spec is None or not others:
                continue
            for child in plugin.element.children:
                if spec.parameter(child.tag) is not None:
                    continue
                parameter = next((p for other in others if (p := other.parameter(child.tag)) is not None), None)
                if parameter is None or child.tag in ("ros", "robotNamespace"):
                    continue
                equivalent = spec.by_meaning(parameter.meaning)
                is_set = equivalent is not None and plugin.element.find(equivalent.tag) is not None
                is_topic = parameter.names == "topic" and spec.generation == "ros2"
                help = "remap the topic with <ros><remapping>from:=to</remapping></ros>" if is_topic else None
                yield self.at(
                    model,
                    child,
                    f"<{child.tag}> is not read in {_NAMES[spec.generation]}",
                    help=f"use <{equivalent.tag}>" if equivalent is not None else help,
                    fix=None if equivalent is None or is_set else new_tag(model, child, equivalent.tag, "unsafe"),
                    kind=spec.generation,
                )
