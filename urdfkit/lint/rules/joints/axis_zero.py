"""J411 axis-zero."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class AxisZero(RobotRule):
    """The axis of a joint has no direction.

    ## What it does
    Looks for ``<axis xyz="0 0 0"/>`` on joints that move.

    ## Why is this bad?
    The joint can move about nothing: MuJoCo refuses it, others divide by zero or leave it rigid.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="continuous">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 0 0"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="continuous">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
      </joint>
    </robot>
    ```
    """

    code = "J411"
    name = "axis-zero"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each axis without direction."""
        for joint in model.robot.joints:
            if joint.type in ("revolute", "continuous", "prismatic", "planar") and not any(joint.axis):
                yield self.at(
                    model,
                    joint.element.find("axis") or joint.element,
                    f"joint `{joint.name}` has the axis 0 0 0, which is no direction",
                    attribute="xyz",
                    joint=joint.name,
                )
