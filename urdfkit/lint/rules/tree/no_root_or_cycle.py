"""T204 no-root-or-cycle."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class NoRootOrCycle(RobotRule):
    """Joints lead from a link back to itself.

    ## What it does
    Follows the joints from child to parent and looks for loops.

    ## Why is this bad?
    URDF describes trees. A loop has no root to start from: check_urdf and Pinocchio refuse it when it is the whole
    robot and silently leave it out when it stands beside a tree; some tools follow it for ever.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
      <joint name="back" type="fixed"><parent link="upper"/><child link="base"/></joint>
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

    code = "T204"
    name = "no-root-or-cycle"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each loop, at the joint that is written last."""
        for loop in model.robot.cycles():
            last = max(loop, key=model.robot.joints.index)
            links = [str(joint.parent) for joint in loop]
            yield self.at(
                model,
                last.element,
                f"the joints form a loop: {' → '.join([*links, links[0]])}",
                attribute="name",
                joint=last.name,
                help="a link has one parent: take one of the joints away",
            )
