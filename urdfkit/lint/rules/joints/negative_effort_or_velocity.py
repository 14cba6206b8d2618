"""J410 negative-effort-or-velocity."""

from urdfkit.description.value_defects import is_minus_one_everywhere
from urdfkit.lint.rule import Findings, Model, RobotRule

_UNITS = {
    "effort": ("N", "N·m"),
    "velocity": ("m/s", "rad/s"),
    "acceleration": ("m/s²", "rad/s²"),
    "deceleration": ("m/s²", "rad/s²"),
    "jerk": ("m/s³", "rad/s³"),
}
"""Attribute → unit for a prismatic joint, and for any other."""


class NegativeEffortOrVelocity(RobotRule):
    """An effort, velocity, acceleration or jerk limit of a joint is negative.

    ## What it does
    Checks for negative ``effort`` and ``velocity`` values in ``<limit>`` and, since URDF 1.2, for negative
    ``acceleration``, ``deceleration`` and ``jerk`` values. A limit of -1 at every joint is reported as a note, because
    exporters write -1 for "no limit", and Gazebo interprets -1 in the same way.

    ## Why is this bad?
    These limits are magnitudes. Pinocchio rejects the robot, and controllers clamp commands to an empty range.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
    -    <limit lower="-1" upper="1" effort="-1" velocity="2"/>
    +    <limit lower="-1" upper="1" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```
    """

    code = "J410"
    name = "negative-effort-or-velocity"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each negative limit."""
        unlimited = {name for name in _UNITS if is_minus_one_everywhere(model.robot, name)}
        for joint in model.robot.joints:
            for name in _UNITS if joint.limit is not None and joint.is_movable else ():
                value = getattr(joint.limit, name)
                if value is not None and value < 0.0 and joint.limit is not None:
                    unit = _UNITS[name][joint.type != "prismatic"]
                    yield self.at(
                        model,
                        joint.limit.element,
                        f"{name} limit {value:g} {unit} of joint `{joint.name}` is negative",
                        attribute=name,
                        joint=joint.name,
                        help="remove the sign, or write a large value if the joint has no limit",
                        severity="note" if name in unlimited else None,
                    )
