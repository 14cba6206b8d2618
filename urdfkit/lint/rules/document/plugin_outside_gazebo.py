"""Z810 plugin-outside-gazebo-tag."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class PluginOutsideGazebo(RobotRule):
    """A ``<plugin>`` or ``<sensor>`` is a direct child of ``<robot>``.

    ## What it does
    Checks for ``<plugin>``, and for ``<sensor>`` in the syntax of Gazebo, outside ``<gazebo>``.

    ## Why is this bad?
    Gazebo reads only the content of ``<gazebo>`` from a URDF, so the plugin or sensor is not loaded.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
    -  <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
    +  <gazebo>
    +    <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
    +  </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: the fix wraps a plugin in ``<gazebo>``. No fix is offered for a sensor, because its link is unknown.
    """

    code = "Z810"
    name = "plugin-outside-gazebo-tag"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each plugin and sensor outside ``<gazebo>``."""
        for element in model.robot.element.children:
            is_sensor = element.tag == "sensor" and element.find("parent") is None and element.get("type") is not None
            if element.tag == "plugin" or is_sensor:
                message = f"<{element.tag}> in <robot> is not read"
                help = 'move it into <gazebo reference="LINK">' if is_sensor else "move it into <gazebo>"
                yield self.at(model, element, message, help=help, fix=None if is_sensor else _wrapped(model, element))


def _wrapped(model: Model, element: Element) -> Fix | None:
    position = element.origin.position
    tag = model.tag(position)
    if tag is None:
        return None
    span = model.document(position.file).source.span
    edits = (Edit(span(tag.start, tag.start), "<gazebo>"), Edit(span(tag.close_end, tag.close_end), "</gazebo>"))
    return Fix("safe", "Wrap in <gazebo>", edits)
