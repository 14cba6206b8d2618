"""Z820 duplicate-sensor-or-plugin-name."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.finding import Finding, Severity
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class DuplicateSensorOrPlugin(RobotRule):
    """Two sensors of a link, or two plugins, have the same name.

    ## What it does
    Compares the names of the sensors of each link (an error) and of plugins in the same scope (a warning). Each sensor
    is a separate scope, so plugins in different sensors can share a name. Equal names of gazebo_ros plugins are
    reported as a note, because in ROS 2 the name of the plugin is the name of its node.

    ## Why is this bad?
    SDF requires unique names: Gazebo rejects the model, or both sensors or plugins publish on the same topic.

    ## Example
    ```diff
     <robot name="cart">
       <link name="mast"/>
       <gazebo reference="mast">
         <sensor name="eye" type="camera"/>
    -    <sensor name="eye" type="depth"/>
    +    <sensor name="depth_eye" type="depth"/>
       </gazebo>
     </robot>
    ```
    """

    code = "Z820"
    name = "duplicate-sensor-or-plugin-name"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each sensor or plugin whose name is already used."""
        sensors: dict[tuple[str, str], Element] = {}
        for block in model.robot.gazebo:
            for sensor in block.sensors:
                if sensor.name and "$" not in sensor.name:
                    first = sensors.setdefault((block.reference or "", sensor.name), sensor.element)
                    if first is not sensor.element:
                        yield self._duplicate(
                            model, sensor.element, f"duplicate sensor name `{sensor.name}` on this link", first
                        )
        by_scope: dict[tuple[int, str], Element] = {}
        by_name: dict[str, Element] = {}
        for plugin, _, within in plugins(model.robot):
            if not plugin.name or "$" in plugin.name or "::" in plugin.name:
                continue
            scope = (id(within) if within is not None else 0, plugin.name)
            first, other = by_scope.setdefault(scope, plugin.element), by_name.setdefault(plugin.name, plugin.element)
            if first is not plugin.element:
                yield self._duplicate(model, plugin.element, f"duplicate plugin name `{plugin.name}`", first, "warning")
            elif other is not plugin.element and "gazebo_ros" in (plugin.filename or ""):
                message = f"plugin name `{plugin.name}` is also used in another sensor"
                yield self._duplicate(model, plugin.element, message, other, "note")

    def _duplicate(
        self, model: Model, element: Element, message: str, first: Element, severity: Severity | None = None
    ) -> Finding:
        help = f"rename one of them; the first is at {model.shown(first.origin.position)}"
        return self.at(model, element, message, attribute="name", help=help, severity=severity)
