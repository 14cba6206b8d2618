"""C708 ros2-control-nested-in-gazebo."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class Ros2ControlInGazebo(RobotRule):
    """``<ros2_control>`` stands inside ``<gazebo>``.

    ## What it does
    Looks for ``<ros2_control>`` as a child of ``<gazebo>``.

    ## Why is this bad?
    ros2_control looks for it in ``<robot>`` only: there is no hardware, and the controller manager does not start.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <gazebo>
        <ros2_control name="arm" type="system">
          <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
        </ros2_control>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <ros2_control name="arm" type="system">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
      </ros2_control>
    </robot>
    ```

    ## Fix safety
    Safe where nothing else is in the ``<gazebo>``, which is taken away; otherwise it is left to you.
    """

    code = "C708"
    name = "ros2-control-nested-in-gazebo"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each block in the wrong place."""
        for block in model.robot.gazebo:
            for child in block.element.find_all("ros2_control"):
                yield self.at(
                    model,
                    child,
                    "<ros2_control> in <gazebo> is not found: it stands in <robot>",
                    fix=_unwrapped(model, block.element) if len(block.element.children) == 1 else None,
                )


def _unwrapped(model: Model, gazebo: Element) -> Fix | None:
    position = gazebo.origin.position
    tag = model.tag(position)
    if tag is None or tag.close is None or tag.name != "gazebo":
        return None
    span = model.document(position.file).source.span
    edits = (Edit(span(tag.start, tag.end), ""), Edit(span(tag.close, tag.close_end), ""))
    return Fix("safe", "Take the <gazebo> around it away", edits)
