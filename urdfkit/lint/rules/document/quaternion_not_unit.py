"""E024 quaternion-not-unit."""

from math import hypot

from urdfkit.description.urdf.values import LARGEST
from urdfkit.description.urdf.version import QUATERNION, version_of
from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

_TOLERANCE = 1e-3
"""Deviation of the norm from 1 that is rounding: numbers with three decimals deviate less."""


class QuaternionNotUnit(RobotRule):
    """A ``quat_xyzw`` is not a unit quaternion.

    ## What it does
    Checks that the norm of ``quat_xyzw`` is 1 within 0.001, in robots of URDF 1.1 or later. A quaternion of zero is
    reported as an error.

    ## Why is this bad?
    The numbers are in the wrong order, or do not come from a quaternion. urdfdom, Pinocchio and urdfkit normalise the
    quaternion and read a zero quaternion as no rotation. Other readers scale the part or reject the robot.

    ## Example
    ```diff
     <robot name="arm" version="1.1">
       <link name="base">
         <visual>
    -      <origin quat_xyzw="0 0 1 1"/>
    +      <origin quat_xyzw="0 0 0.70710678 0.70710678"/>
           <geometry><box size="0.1 0.1 0.3"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Safe: the fix normalises the quaternion, as readers do. No fix is offered for zero.
    """

    code = "E024"
    name = "quaternion-not-unit"
    severity = "warning"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each quaternion whose norm is not 1."""
        if version_of(model.robot.element) < QUATERNION:
            return
        for origin in model.elements:
            text = origin.attributes.get("quat_xyzw") if origin.tag == "origin" else None
            values = numbers(text) if text is not None else None
            norm = hypot(*values) if values is not None and len(values) == 4 else 1.0
            if not abs(norm - 1.0) > _TOLERANCE or norm > LARGEST:
                continue
            unit = " ".join(f"{value / norm:.9g}" for value in values or ()) if norm else ""
            yield self.at(
                model,
                origin,
                f'quat_xyzw="{text}" has the norm {norm:g}, not 1' if norm else f'quat_xyzw="{text}" is not a rotation',
                attribute="quat_xyzw",
                help=f'write quat_xyzw="{unit}"' if norm else 'write quat_xyzw="0 0 0 1" for no rotation',
                fix=new_value(model, origin, "quat_xyzw", unit, "safe", "Normalise the quaternion") if norm else None,
                severity=None if norm else "error",
            )
