"""T201 parent-link-undefined."""

from __future__ import annotations

from urdfkit.description.queries import dangling
from urdfkit.lint.edits import meant, new_value
from urdfkit.lint.hidden import doubted
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

    ## Fix safety
    Unsafe: the link with the nearest name is taken.
    """

    code = "T201"
    name = "parent-link-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint whose parent is no link."""
        for joint, name, element in dangling(model.robot, "parent"):
            near, hint = meant(name, model.robot.link_by_name)
            found = self.at(
                model,
                element,
                f"joint `{joint.name}` has the parent `{name}`, which is no link{hint}",
                attribute="link",
                joint=joint.name,
                fix=new_value(model, element, "link", near, "unsafe", f"Write `{near}`") if near else None,
            )
            yield from doubted(model, name, near, found)
