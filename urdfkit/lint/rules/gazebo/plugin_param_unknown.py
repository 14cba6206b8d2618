"""Z805 plugin-param-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import new_tag
from urdfkit.lint.gazebo import is_foreign, plugins, spec_of
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


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
        from urdfkit.description.plugins.unread import unread

        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target) if not is_foreign(plugin, model) else None
            for each in unread(plugin, spec) if spec is not None else ():
                if each.promised:
                    yield self.at(model, each.element, each.message, severity="info")
                    continue
                meant = each.meant
                yield self.at(
                    model,
                    each.element,
                    each.message,
                    help=f"did you mean <{meant}>?" if meant else None,
                    fix=new_tag(model, each.element, meant, "unsafe", f"Write <{meant}>") if meant else None,
                )
