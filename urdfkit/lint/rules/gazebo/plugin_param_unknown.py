"""Z805 plugin-param-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_tag
from urdfkit.lint.gazebo import HARMLESS, READ_TOO, plugins, spec_of, specs
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_NAMES = {"ros1": "ROS 1", "ros2": "ROS 2", "gz": "the new Gazebo"}
_KNOWN = {("diff_drive", "ros1", "torque"): "wheelTorque", ("diff_drive", "ros1", "broadcastTF"): "publishOdomTF"}
"""What is copied from another plugin, and what means it here."""

_PROMISED = {
    ("diff_drive", "ros2", "odometry_topic"),
    ("diff_drive", "ros2", "command_topic"),
    ("openni_kinect", "ros1", "baseline"),
}
"""What the comment at the top of a plugin's header, or Gazebo's own tutorial, shows."""


class PluginParamUnknown(RobotRule):
    """A plugin has no such parameter.

    ## What it does
    Compares what is written in a plugin with what its source reads, for the plugins it knows. Nothing is said of
    other libraries.

    ## Why is this bad?
    The plugin does not complain: it takes its default. ``<torque>`` does not make the wheels of the differential
    drive stronger, ``<wheelTorque>`` does.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planar_move.so">
          <odometryRates>20</odometryRates>
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
          <odometryRate>20</odometryRate>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the parameter with the nearest name is taken, and the robot behaves differently from then on.
    """

    code = "Z805"
    name = "plugin-param-unknown"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each parameter that the plugin does not read, in no generation."""
        from urdfkit.description.plugins.lookup import stem

        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target)
            if spec is None:
                continue
            every = {parameter.tag for other in specs(plugin) for parameter in other.parameters}
            also = READ_TOO.get(stem(plugin.filename or ""), ())
            known = [parameter.tag for parameter in spec.parameters]
            for child in plugin.element.children:
                tag = child.tag
                if tag in every or tag in also or tag in HARMLESS or ":" in tag:
                    continue
                if (spec.kind, spec.generation, tag) in _PROMISED:
                    message = f"<{tag}> is shown in examples of the plugin, but not read"
                    yield self.at(model, child, message, severity="info")
                    continue
                meant = _KNOWN.get((spec.kind, spec.generation, tag)) or nearest(tag, known, likeness=0.8)
                is_there = meant is not None and plugin.element.find(meant) is not None
                yield self.at(
                    model,
                    child,
                    f"<{tag}> is read by no {spec.kind.replace('_', ' ')} of {_NAMES[spec.generation]}",
                    help=f"did you mean <{meant}>?" if meant and not is_there else None,
                    fix=new_tag(model, child, meant, "unsafe", f"Write <{meant}>") if meant and not is_there else None,
                )
