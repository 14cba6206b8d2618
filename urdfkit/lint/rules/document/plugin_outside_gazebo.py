"""Z810 plugin-outside-gazebo-tag."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class PluginOutsideGazebo(RobotRule):
    """A plugin or a sensor stands directly in ``<robot>``.

    ## What it does
    Looks for ``<plugin>``, and for ``<sensor>`` as Gazebo writes it, outside of ``<gazebo>``.

    ## Why is this bad?
    Nobody reads it there: Gazebo takes only what is in ``<gazebo>`` over from a URDF.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <gazebo>
        <plugin name="move" filename="libgazebo_ros_planar_move.so"/>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Safe: ``<gazebo>`` is written around a plugin. A sensor needs the link it is on, which you have to say.
    """

    code = "Z810"
    name = "plugin-outside-gazebo-tag"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each plugin and sensor that nobody reads."""
        for element in model.robot.element.children:
            is_sensor = element.tag == "sensor" and element.find("parent") is None and element.get("type") is not None
            if element.tag == "plugin" or is_sensor:
                yield self.at(
                    model,
                    element,
                    f"<{element.tag}> in <robot> is read by nobody",
                    help='put it into <gazebo reference="LINK">' if is_sensor else "put it into <gazebo>",
                    fix=None if is_sensor else _wrapped(model, element),
                )


def _wrapped(model: Model, element: Element) -> Fix | None:
    position = element.origin.position
    tag = model.tag(position)
    if tag is None:
        return None
    span = model.document(position.file).source.span
    edits = (Edit(span(tag.start, tag.start), "<gazebo>"), Edit(span(tag.close_end, tag.close_end), "</gazebo>"))
    return Fix("safe", "Put <gazebo> around it", edits)
