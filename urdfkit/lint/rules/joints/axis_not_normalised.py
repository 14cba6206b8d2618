"""J412 axis-not-normalised."""

from urdfkit.description.urdf.geometry import unit
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

TOLERANCE = 1e-3
"""Accepted deviation of the length from 1, so that rounded axes (0.577 0.577 0.577) pass."""


class AxisNotNormalised(RobotRule):
    """The axis of a joint is not a unit vector.

    ## What it does
    Checks the length of the axis of each movable joint. A deviation of up to 0.001 is accepted.

    ## Why is this bad?
    urdfdom and KDL use the vector as written, which scales the motion of the joint by the length of the axis.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous">
         <parent link="base"/>
         <child link="arm"/>
    -    <axis xyz="0 1 1"/>
    +    <axis xyz="0 0.70710678 0.70710678"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Safe: the fix keeps the direction of the axis.
    """

    code = "J412"
    name = "axis-not-normalised"
    severity = "warning"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each axis that is not a unit vector."""
        for joint in model.robot.joints:
            length = sum(value * value for value in joint.axis) ** 0.5
            axis, direction = joint.element.find("axis"), unit(joint.axis)
            if abs(length - 1.0) <= TOLERANCE or not joint.is_movable or axis is None or direction is None:
                continue
            value = " ".join(f"{part + 0.0:.8g}" for part in direction)
            message = f"the axis of joint `{joint.name}` has length {length:.4g} instead of 1"
            fix = new_value(model, axis, "xyz", value, "safe", "Normalise the axis")
            yield self.at(model, axis, message, attribute="xyz", joint=joint.name, help=f'write xyz="{value}"', fix=fix)
