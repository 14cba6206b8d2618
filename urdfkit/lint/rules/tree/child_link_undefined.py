"""T202 child-link-undefined."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class ChildLinkUndefined(RobotRule):
    """A joint's child is no link.

    ## What it does
    Looks for joints whose ``<child>`` names a link that is not there, and names the nearest one that is.

    ## Why is this bad?
    The joint carries nothing: urdfdom, Pinocchio and every viewer refuse the robot.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
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

    code = "T202"
    name = "child-link-undefined"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint whose child is no link."""
        robot = model.robot
        if model.is_incomplete:
            return
        for joint in robot.joints:
            if joint.child is not None and joint.child not in robot.link_by_name:
                from urdfkit.errors import did_you_mean

                yield self.at(
                    model,
                    joint.element.find("child") or joint.element,
                    f"joint `{joint.name}` has the child `{joint.child}`, which is no link"
                    f"{did_you_mean(joint.child, robot.link_by_name)}",
                    attribute="link",
                    joint=joint.name,
                )
