"""J418 axis-or-limit-on-fixed."""

from __future__ import annotations

from urdfkit.lint.edits import without_element
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class AxisOrLimitOnFixed(RobotRule):
    """A fixed joint has an axis or a limit.

    ## What it does
    Looks for ``<limit>``, and for ``<axis>`` with a direction, on joints of type ``fixed``. Exporters write ``0 0
    0`` there.

    ## Why is this bad?
    They are not read. Perhaps the joint was meant to move.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="tool"/>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="tool"/>
        <axis xyz="0 0 1"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="tool"/>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="tool"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Safe: nobody reads what is taken away.
    """

    code = "J418"
    name = "axis-or-limit-on-fixed"
    severity = "info"
    fix = "safe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each axis or limit of a fixed joint."""
        for joint in model.robot.joints:
            if joint.type != "fixed":
                continue
            for child in joint.element.children:
                if child.tag == "limit" or (child.tag == "axis" and any(joint.axis)):
                    yield self.at(
                        model,
                        child,
                        f"joint `{joint.name}` is fixed: <{child.tag}> is not read",
                        joint=joint.name,
                        fix=without_element(model, child, "safe", f"Take <{child.tag}> away"),
                    )
