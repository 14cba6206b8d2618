"""Z816 deprecated-gazebo-tag."""

from urdfkit.lint.fix_builders import new_tag
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class DeprecatedGazeboTag(RobotRule):
    """A Gazebo element is deprecated.

    ## What it does
    Checks for ``<cfmDamping>``, the only element that sdformat has deprecated.

    ## Why is this bad?
    sdformat still reads the element, but logs a warning at every start.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="wheel"/>
       <joint name="axle" type="fixed"><parent link="base"/><child link="wheel"/></joint>
       <gazebo reference="axle">
    -    <cfmDamping>true</cfmDamping>
    +    <implicitSpringDamper>true</implicitSpringDamper>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Safe: sdformat treats ``<cfmDamping>`` and ``<implicitSpringDamper>`` alike.
    """

    code = "Z816"
    name = "deprecated-gazebo-tag"
    severity = "warning"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each deprecated element."""
        for block in model.robot.gazebo:
            for child in block.element.children:
                if child.tag == "cfmDamping":
                    message = "<cfmDamping> is deprecated; use <implicitSpringDamper>"
                    yield self.at(model, child, message, fix=new_tag(model, child, "implicitSpringDamper", "safe"))
