"""J423 mimic-beyond-limits."""

from urdfkit.description.urdf.robot import Joint
from urdfkit.lint.rule import Findings, Model, RobotRule

_PART = 0.5
"""Smallest part of the positions that a joint mimics which its limits must contain."""


class MimicBeyondLimits(RobotRule):
    """A mimic joint follows another joint to positions outside its own limits.

    ## What it does
    Computes the positions of each joint with ``<mimic>`` while the other joint moves between its limits:
    multiplier · position + offset. Reports the joint if its own limits contain less than half of these positions.

    ## Why is this bad?
    A simulator stops the joint at its limit, or the two joints push against each other. The usual cause is the sign of
    the multiplier or the wrong joint name.

    ## Example
    ```diff
     <robot name="gripper">
       <link name="palm"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="prismatic">
         <parent link="palm"/><child link="left"/>
         <axis xyz="0 1 0"/>
         <limit lower="0" upper="0.03" effort="20" velocity="0.2"/>
       </joint>
       <joint name="right_joint" type="prismatic">
         <parent link="palm"/><child link="right"/>
         <axis xyz="0 -1 0"/>
         <limit lower="0" upper="0.03" effort="20" velocity="0.2"/>
    -    <mimic joint="left_joint" multiplier="-1"/>
    +    <mimic joint="left_joint"/>
       </joint>
     </robot>
    ```
    """

    code = "J423"
    name = "mimic-beyond-limits"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that mimics positions beyond its limits."""
        for joint in model.robot.joints:
            mimic = joint.mimic
            other = model.robot.joint_by_name.get(mimic.joint or "") if mimic is not None else None
            own, followed = _range(joint), _range(other)
            if mimic is None or other is None or own is None or followed is None:
                continue
            low, high = sorted(mimic.multiplier * value + mimic.offset for value in followed)
            inside = min(high, own[1]) - max(low, own[0])
            if inside >= _PART * (high - low) or high <= low:
                continue
            unit = "m" if joint.type == "prismatic" else "rad"
            message = f"joint `{joint.name}` mimics `{other.name}` from {low:.4g} to {high:.4g} {unit}, "
            message += f"but its limits are {own[0]:.4g} and {own[1]:.4g} {unit}"
            help = "check the joint, the sign of the multiplier and the limits"
            yield self.at(model, mimic.element, message, joint=joint.name, names=(other.name,), help=help)


def _range(joint: Joint | None) -> tuple[float, float] | None:
    """Return the limits of a revolute or prismatic joint; None if they are missing or in the wrong order."""
    if joint is None or joint.type not in ("revolute", "prismatic") or joint.limit is None:
        return None
    low, high = joint.limit.lower or 0.0, joint.limit.upper or 0.0
    return (low, high) if low < high else None
