"""J402 joint-type-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.lint.fix_builders import nearest, new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

_FOREIGN_TYPES = {
    "hinge": "revolute",
    "rotational": "revolute",
    "rotary": "revolute",
    "revolving": "revolute",
    "slider": "prismatic",
    "slide": "prismatic",
    "linear": "prismatic",
    "translational": "prismatic",
    "rigid": "fixed",
    "weld": "fixed",
    "static": "fixed",
    "free": "floating",
    "ball": "floating",
    "spherical": "floating",
}
"""Joint type of another format (SDF, MJCF, USD, Drake) or common term → closest URDF type."""


class JointTypeUnknown(RobotRule):
    """A joint has an unknown ``type``.

    ## What it does
    Checks for joints whose ``type`` is not ``fixed``, ``revolute``, ``continuous``, ``prismatic``, ``planar`` or
    ``floating``.

    ## Why is this bad?
    Every parser rejects the robot. Joint types of other formats, such as ``hinge`` and ``ball``, are not part of URDF.
    Types are case-sensitive.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
    -  <joint name="shoulder" type="Fixed"><parent link="base"/><child link="upper"/></joint>
    +  <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
     </robot>
    ```

    ## Fix safety
    Safe if the type is misspelt by one or two letters; a joint corrected to ``revolute`` may then lack its limits,
    which another rule reports. Unsafe if the fix replaces a joint type of another format with its closest equivalent in
    URDF.
    """

    code = "J402"
    name = "joint-type-unknown"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with an unknown type."""
        from urdfkit.description.urdf.robot import JOINT_TYPES

        for joint in model.robot.joints:
            if joint.type is None or joint.type in JOINT_TYPES:
                continue
            is_typo = nearest(joint.type.strip(), JOINT_TYPES, cutoff=0.85) is not None
            suggestion = _FOREIGN_TYPES.get(joint.type.lower()) or nearest(joint.type.strip(), JOINT_TYPES)
            message = f"unknown type `{joint.type}` of joint `{joint.name}`" + Suggestion(suggestion)
            help = f"use one of {', '.join(JOINT_TYPES)}"
            fix = new_value(model, joint.element, "type", suggestion, "safe" if is_typo else "unsafe")
            yield self.at(model, joint.element, message, attribute="type", joint=joint.name, help=help, fix=fix)
