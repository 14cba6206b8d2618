"""T201 parent-link-undefined."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class ParentLinkUndefined(RobotRule):
    """A joint's parent is no link.

    ## What it does
    Looks for joints whose ``<parent>`` names a link that is not there, and names the nearest one that is.

    ## Why is this bad?
    The joint hangs on nothing: urdfdom, Pinocchio and every viewer refuse the robot.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <joint name="shoulder" type="fixed"><parent link="bsae"/><child link="upper"/></joint>
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

    code = "T201"
    name = "parent-link-undefined"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint whose parent is no link."""
        robot = model.robot
        if model.is_incomplete:
            return
        for joint in robot.joints:
            if joint.parent is not None and joint.parent not in robot.link_by_name:
                from urdfkit.errors import did_you_mean

                yield self.at(
                    model,
                    joint.element.find("parent") or joint.element,
                    f"joint `{joint.name}` has the parent `{joint.parent}`, which is no link"
                    f"{did_you_mean(joint.parent, robot.link_by_name)}",
                    attribute="link",
                    joint=joint.name,
                )
