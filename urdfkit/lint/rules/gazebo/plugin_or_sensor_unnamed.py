"""Z829 plugin-or-sensor-unnamed."""

from urdfkit.lint.facts.gazebo.plugins import plugins
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginOrSensorUnnamed(RobotRule):
    """A plugin or sensor has no name.

    ## What it does
    Checks for ``<plugin>`` and ``<sensor>`` elements with a missing or empty ``name``.

    ## Why is this bad?
    Gazebo reports "Required attribute[name] in element[plugin] is not specified in SDF" and ignores the rest of the
    model.

    ## Example
    ```diff
     <robot name="cart">
       <link name="mast"/>
       <gazebo reference="mast">
    -    <sensor type="camera"/>
    +    <sensor name="eye" type="camera"/>
       </gazebo>
     </robot>
    ```
    """

    code = "Z829"
    name = "plugin-or-sensor-unnamed"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each unnamed plugin and sensor."""
        named = [(plugin.name, plugin.element) for plugin, _, _ in plugins(model.robot)]
        named += [(sensor.name, sensor.element) for block in model.robot.gazebo for sensor in block.sensors]
        for name, element in named:
            if not (name or "").strip():
                yield self.at(model, element, f"<{element.tag}> has no name", help='add name="…"')
