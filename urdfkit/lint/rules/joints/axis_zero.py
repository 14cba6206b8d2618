"""J411 axis-zero."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class AxisZero(RobotRule):
    """The axis of a movable joint is zero.

    ## What it does
    Checks for ``<axis xyz="0 0 0"/>`` in movable joints.

    ## Why is this bad?
    A zero vector has no direction. MuJoCo rejects the joint; other tools divide by zero or treat the joint as fixed.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous">
         <parent link="base"/>
         <child link="arm"/>
    -    <axis xyz="0 0 0"/>
    +    <axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```
    """

    code = "J411"
    name = "axis-zero"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each axis of length zero."""
        for joint in model.robot.joints:
            if joint.type in ("revolute", "continuous", "prismatic", "planar") and not joint.has_axis:
                axis = " ".join(f"{part:g}" for part in joint.axis)
                place = joint.element.find("axis") or joint.element
                message = f"joint `{joint.name}` has the axis {axis}, which has no direction"
                help = "write the direction of the axis, such as 0 0 1"
                yield self.at(model, place, message, attribute="xyz", joint=joint.name, help=help)
