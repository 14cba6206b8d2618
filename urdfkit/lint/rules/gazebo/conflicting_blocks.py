"""Z822 conflicting-gazebo-blocks."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class ConflictingBlocks(RobotRule):
    """Two ``<gazebo>`` blocks set the same element to different values.

    ## What it does
    Compares the values in all ``<gazebo>`` blocks that reference the same link or joint.

    ## Why is this bad?
    Only one of the values takes effect, and SDF does not specify which one.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
    -  <gazebo reference="base">
    -    <material>Gazebo/Blue</material>
    -  </gazebo>
       <gazebo reference="base">
         <material>Gazebo/Green</material>
       </gazebo>
     </robot>
    ```
    """

    code = "Z822"
    name = "conflicting-gazebo-blocks"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each value that contradicts an earlier one."""
        first_by_name: dict[tuple[str, str], Element] = {}
        for block in model.robot.gazebo:
            for child in block.element.children if block.reference else ():
                value = _value(child)
                if value and not child.children:
                    first = first_by_name.setdefault((block.reference or "", child.tag), child)
                    if _value(first) != value:
                        message = f"<{child.tag}> of `{block.reference}` is {value} here but {_value(first)} elsewhere"
                        help = f"remove one of them; the other is at {model.shown(first.origin.position)}"
                        yield self.at(model, child, message, help=help)


def _value(element: Element) -> str:
    return " ".join((element.text or element.get("value") or "").split())
