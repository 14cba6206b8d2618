"""T204 no-root-or-cycle."""

from urdfkit.description.urdf.queries import cycles
from urdfkit.lint.rule import Findings, Model, RobotRule


class NoRootOrCycle(RobotRule):
    """The joints of the robot form a loop.

    ## What it does
    Follows the joints from child to parent and checks for loops.

    ## Why is this bad?
    A URDF robot is a tree, and a loop has no root. check_urdf and Pinocchio reject a robot that consists only of a
    loop, and silently drop a loop next to a tree. Some tools do not terminate.

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

    def check(self, model: Model) -> Findings:
        """Yield a finding for each loop, at the last of its joints in the file."""
        for loop in cycles(model.robot):
            last = max(loop, key=model.robot.joints.index)
            links = [str(joint.parent) for joint in loop]
            yield self.at(
                model,
                last.element,
                f"the joints form a loop: {' → '.join([*links, links[0]])}",
                attribute="name",
                joint=last.name,
                help="remove one of the joints: each link has at most one parent",
            )
