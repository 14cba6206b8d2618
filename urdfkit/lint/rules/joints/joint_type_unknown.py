"""J402 joint-type-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_value
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_ELSEWHERE = {
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
"""Types of joints in other formats (SDF, MJCF, USD, Drake) and in speech → the nearest of URDF."""


class JointTypeUnknown(RobotRule):
    """A joint's type is none of the six.

    ## What it does
    Looks for joints whose ``type`` is not fixed, revolute, continuous, prismatic, planar or floating.

    ## Why is this bad?
    Every parser refuses the robot. Types of other formats (``hinge``, ``ball``) are not URDF,
    and case counts.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <joint name="shoulder" type="Fixed"><parent link="base"/><child link="upper"/></joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
    </robot>
    ```

    ## Fix safety
    Safe where a letter or two are wrong; a revolute joint may lack its limits then, which is reported next. Unsafe
    where it is a guess: what other formats' types come nearest to.
    """

    code = "J402"
    name = "joint-type-unknown"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint of unknown type."""
        from urdfkit.description.robot import JOINT_TYPES

        for joint in model.robot.joints:
            if joint.type is None or joint.type in JOINT_TYPES:
                continue
            near = nearest(joint.type.strip(), JOINT_TYPES, likeness=0.85)
            right = _ELSEWHERE.get(joint.type.lower()) or nearest(joint.type.strip(), JOINT_TYPES)
            yield self.at(
                model,
                joint.element,
                f"joint `{joint.name}` has the type `{joint.type}`, which is none"
                + (f"; did you mean `{right}`?" if right else ""),
                attribute="type",
                joint=joint.name,
                help=f"the types are {', '.join(JOINT_TYPES)}",
                fix=new_value(model, joint.element, "type", right, "safe" if near else "unsafe", f"Write `{right}`")
                if right
                else None,
            )
