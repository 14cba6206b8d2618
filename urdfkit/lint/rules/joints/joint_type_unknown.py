"""J402 joint-type-unknown."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


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
    """

    code = "J402"
    name = "joint-type-unknown"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint of unknown type."""
        from urdfkit.description.robot import JOINT_TYPES

        for joint in model.robot.joints:
            if joint.type is not None and joint.type not in JOINT_TYPES:
                from urdfkit.errors import did_you_mean

                meant = {"hinge": "revolute", "slider": "prismatic", "free": "floating", "ball": "floating"}
                likely = meant.get(joint.type.lower())
                hint = f"; `{likely}` is nearest" if likely else did_you_mean(joint.type, JOINT_TYPES)
                yield self.at(
                    model,
                    joint.element,
                    f"joint `{joint.name}` has the type `{joint.type}`, which is none{hint}",
                    attribute="type",
                    joint=joint.name,
                    help=f"the types are {', '.join(JOINT_TYPES)}",
                )
