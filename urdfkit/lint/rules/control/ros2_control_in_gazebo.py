"""C708 ros2-control-nested-in-gazebo."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class Ros2ControlInGazebo(RobotRule):
    """``<ros2_control>`` is inside ``<gazebo>``.

    ## What it does
    Checks for ``<ros2_control>`` as a child of ``<gazebo>``.

    ## Why is this bad?
    ros2_control reads only children of ``<robot>``, so it finds no hardware and the controller manager does not start.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
    -  <gazebo>
    -    <ros2_control name="arm" type="system">
    -      <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    -    </ros2_control>
    -  </gazebo>
    +  <ros2_control name="arm" type="system">
    +    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    +  </ros2_control>
     </robot>
    ```

    ## Fix safety
    Safe: the fix removes the surrounding ``<gazebo>`` tags. No fix is offered if ``<gazebo>`` has other children.
    """

    code = "C708"
    name = "ros2-control-nested-in-gazebo"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misplaced block."""
        for block in model.robot.gazebo:
            for child in block.element.find_all("ros2_control"):
                message = "<ros2_control> inside <gazebo> is not read"
                fix = _without_parent(model, block.element) if len(block.element.children) == 1 else None
                yield self.at(model, child, message, help="move it into <robot>", fix=fix)


def _without_parent(model: Model, gazebo: Element) -> Fix | None:
    position = gazebo.origin.position
    tag = model.tag(position)
    if tag is None or tag.close is None or tag.name != "gazebo":
        return None
    span = model.document(position.file).source.span
    edits = (Edit(span(tag.start, tag.end), ""), Edit(span(tag.close, tag.close_end), ""))
    return Fix("safe", "Remove the surrounding <gazebo>", edits)
