"""T205 multiple-parents."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MultipleParents(RobotRule):
    """A link is the child of more than one joint.

    ## What it does
    Looks for links that several joints name as their child.

    ## Why is this bad?
    URDF describes trees: a link has one parent. check_urdf says nothing and keeps one of the joints; Pinocchio and
    MuJoCo refuse the robot.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <link name="hand"/>
      <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
      <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
      <joint name="brace" type="fixed"><parent link="base"/><child link="hand"/></joint>
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

    code = "T205"
    name = "multiple-parents"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint that takes a child which has a parent already."""
        for name, joints in model.robot.parents_of.items():
            first = joints[0]
            for joint in joints[1:]:
                if joint.name == first.name:
                    continue  # The same joint twice is another matter: duplicate names.
                child = joint.element.find("child") or joint.element
                yield self.at(
                    model,
                    child,
                    f"link `{name}` is the child of joint `{joint.name}` and of joint `{first.name}`",
                    attribute="link",
                    link=name,
                    joint=joint.name,
                    help=f"give `{joint.name}` a link of its own, or remove one of the joints",
                )
