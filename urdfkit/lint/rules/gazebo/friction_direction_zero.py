"""Z814 fdir1-zero."""

from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.fix_builders import without_element
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class FrictionDirectionZero(RobotRule):
    """The friction direction has zero length.

    ## What it does
    Checks for ``<fdir1>`` of ``0 0 0``.

    ## Why is this bad?
    Physics engines divide by the length of the vector, or ignore friction.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <gazebo reference="base">
    -    <fdir1>0 0 0</fdir1>
    +    <fdir1>1 0 0</fdir1>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: a zero vector specifies no direction, and without ``<fdir1>`` friction is isotropic.
    """

    code = "Z814"
    name = "fdir1-zero"
    severity = "warning"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each direction of zero length."""
        for block in model.robot.gazebo:
            for element in block.element.walk():
                if element.tag != "fdir1":
                    continue
                values = numbers(element.text or element.get("value") or "")
                if values and not any(values):
                    fix = without_element(model, element, "safe", "Remove <fdir1>")
                    yield self.at(model, element, "<fdir1> 0 0 0 has zero length", fix=fix)
