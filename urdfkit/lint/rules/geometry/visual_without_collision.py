"""G610 visual-without-collision."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule
from urdfkit.lint.wheels import drives

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding, Severity
    from urdfkit.lint.model import Model


class VisualWithoutCollision(RobotRule):
    """A link can be seen but not touched.

    ## What it does
    Looks for links with ``<visual>`` and without ``<collision>`` in robots where other links have one. It is a warning
    for wheels that a plugin drives.

    ## Why is this bad?
    Planners and simulators let everything pass through it, and such a wheel sinks into the ground.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base">
        <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
        <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
      </link>
      <link name="mast">
        <visual><geometry><cylinder radius="0.02" length="0.5"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="mast"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base">
        <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
        <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
      </link>
      <link name="mast">
        <visual><geometry><cylinder radius="0.02" length="0.5"/></geometry></visual>
        <collision><geometry><cylinder radius="0.02" length="0.5"/></geometry></collision>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="mast"/>
      </joint>
    </robot>
    ```
    """

    code = "G610"
    name = "visual-without-collision"
    severity = "info"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each link that is seen only, at its first visual."""
        if not any(link.collisions for link in model.robot.links):
            return
        driven = {wheel.joint.child for drive in drives(model) for wheel in (*drive.left, *drive.right)}
        for link in model.robot.links:
            if link.visuals and not link.collisions:
                message = f"link `{link.name}` has a visual shape and none for collisions"
                if link.name in driven:
                    message = f"the driven wheel `{link.name}` has no shape for collisions: it sinks into the ground"
                severity: Severity | None = "warning" if link.name in driven else None
                yield self.at(model, link.visuals[0].element, message, link=link.name, severity=severity)
