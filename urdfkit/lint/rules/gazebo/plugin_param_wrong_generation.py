"""Z806 plugin-param-wrong-generation."""

from __future__ import annotations

from urdfkit.lint.edits import new_tag
from urdfkit.lint.gazebo import plugins, spec_of, specs
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_NAMES = {"ros1": "ROS 1", "ros2": "ROS 2", "gz": "the new Gazebo"}


class PluginParamWrongGeneration(RobotRule):
    """A plugin is given a parameter in the spelling of another generation.

    ## What it does
    ROS 1 spells parameters in camelCase, ROS 2 and the new Gazebo in snake_case, and some changed their meaning. A
    plugin is taken for that of the target, else for the generation that most of its parameters are spelt in.

    ## Why is this bad?
    The plugin does not complain: it takes its default, and topics, frames and wheels are other ones than you wrote.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planar_move.so">
          <update_rate>50</update_rate>
          <publish_odom>true</publish_odom>
          <odometryFrame>odom</odometryFrame>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planar_move.so">
          <update_rate>50</update_rate>
          <publish_odom>true</publish_odom>
          <odometry_frame>odom</odometry_frame>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the parameter of the same meaning is written, and the robot behaves differently from then on.
    """

    code = "Z806"
    name = "plugin-param-wrong-generation"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each parameter that only another generation reads."""
        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target)
            others = [other for other in specs(plugin) if other is not spec]
            if spec is None or not others:
                continue
            for child in plugin.element.children:
                if spec.parameter(child.tag) is not None:
                    continue
                found = next((p for other in others if (p := other.parameter(child.tag)) is not None), None)
                if found is None or child.tag in ("ros", "robotNamespace"):
                    continue
                ours = spec.by_meaning(found.meaning)
                is_there = ours is not None and plugin.element.find(ours.tag) is not None
                topic = found.names == "topic" and spec.generation == "ros2"
                help = "in ROS 2 topics are changed by <ros><remapping>from:=to</remapping></ros>" if topic else None
                yield self.at(
                    model,
                    child,
                    f"<{child.tag}> is not read in {_NAMES[spec.generation]}",
                    help=f"there it is <{ours.tag}>" if ours is not None else help,
                    fix=None
                    if ours is None or is_there
                    else new_tag(model, child, ours.tag, "unsafe", f"Write <{ours.tag}>"),
                )
