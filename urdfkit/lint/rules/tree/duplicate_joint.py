"""T207 duplicate-joint."""

from __future__ import annotations

from urdfkit.description.queries import repeated
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class DuplicateJoint(RobotRule):
    """Two joints have the same name.

    ## What it does
    Looks for joints that carry the name of an earlier one.

    ## Why is this bad?
    Names are how everything refers to a joint. urdfdom refuses the robot; tools that do not, keep either of the two.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <link name="hand"/>
      <joint name="wrist" type="fixed"><parent link="base"/><child link="upper"/></joint>
      <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <link name="hand"/>
      <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
      <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
    </robot>
    ```
    """

    code = "T207"
    name = "duplicate-joint"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint whose name is taken."""
        for joint, first in repeated(model.robot.joints):
            yield self.at(
                model,
                joint.element,
                f"joint `{joint.name}` is there already",
                attribute="name",
                joint=joint.name,
                help=f"the first is at {model.shown(first.element.origin.position)}",
            )
