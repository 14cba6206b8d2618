"""Z805 plugin-param-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.facts.gazebo.plugins import is_foreign, plugins, spec_of
from urdfkit.lint.fix_builders import new_tag
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginParamUnknown(RobotRule):
    """A plugin parameter is unknown.

    ## What it does
    Compares the elements of each known plugin with the parameters that its source code reads. Other libraries are not
    checked.

    ## Why is this bad?
    The plugin ignores the element and uses its default. For example, the differential drive reads ``<wheelTorque>`` and
    ignores ``<torque>``.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <gazebo>
         <plugin name="move" filename="libgazebo_ros_planar_move.so">
    -      <odometryRates>20</odometryRates>
    +      <odometryRate>20</odometryRate>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix renames the element to the nearest parameter, which changes the behaviour of the robot.
    """

    code = "Z805"
    name = "plugin-param-unknown"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter that no generation of the plugin reads."""
        from urdfkit.description.plugins.unread_parameters import unread

        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target) if not is_foreign(plugin, model) else None
            for parameter in unread(plugin, spec) if spec is not None else ():
                if parameter.promised:
                    yield self.at(model, parameter.element, parameter.message, severity="note", kind="promised")
                    continue
                suggestion = parameter.meant
                help = Suggestion(f"<{suggestion}>", before="") if suggestion else None
                fix = new_tag(model, parameter.element, suggestion, "unsafe")
                kind = f"{spec.kind} {spec.generation}" if spec is not None else ""
                yield self.at(model, parameter.element, parameter.message, help=help, fix=fix, kind=kind)
