"""J413 axis-missing-on-movable."""

from __future__ import annotations

from urdfkit.lint.edits import more_children
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class AxisMissing(RobotRule):
    """A joint that moves has no axis.

    ## What it does
    Looks for joints of type ``revolute``, ``continuous``, ``prismatic`` and ``planar`` without ``<axis>`` whose
    child has a shape or a mass.

    ## Why is this bad?
    The default is x, not z as many expect: say so where it is meant.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm">
        <visual><geometry><sphere radius="0.1"/></geometry></visual>
      </link>
      <joint name="elbow" type="continuous">
        <parent link="base"/>
        <child link="arm"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm">
        <visual><geometry><sphere radius="0.1"/></geometry></visual>
      </link>
      <joint name="elbow" type="continuous">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="1 0 0"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Safe: the default is written out.
    """

    code = "J413"
    name = "axis-missing-on-movable"
    severity = "info"
    fix = "safe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint that relies on the default."""
        for joint in model.robot.joints:
            if (
                joint.type not in ("revolute", "continuous", "prismatic", "planar")
                or joint.element.find("axis") is not None
            ):
                continue
            child = model.robot.link_by_name.get(joint.child or "")
            if child is not None and (child.visuals or child.collisions or child.inertial is not None):
                yield self.at(
                    model,
                    joint.element,
                    f"{joint.type} joint `{joint.name}` has no axis: it is x (1 0 0) then",
                    attribute="name",
                    joint=joint.name,
                    fix=more_children(model, joint.element, '<axis xyz="1 0 0"/>', "safe", "Write the default axis"),
                )
