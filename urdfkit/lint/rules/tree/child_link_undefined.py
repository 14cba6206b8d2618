"""T202 child-link-undefined."""

from __future__ import annotations

from urdfkit.description.queries import dangling
from urdfkit.lint.edits import new_value
from urdfkit.lint.hidden import doubted
from urdfkit.lint.orphans import meant_child
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

    ## Fix safety
    Unsafe: the link with the nearest name is taken.
    """

    code = "T202"
    name = "child-link-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint whose child is no link."""
        for joint, name, element in dangling(model.robot, "child"):
            near, hint = meant_child(model.robot, name)
            found = self.at(
                model,
                element,
                f"joint `{joint.name}` has the child `{name}`, which is no link{hint}",
                attribute="link",
                joint=joint.name,
                fix=new_value(model, element, "link", near, "unsafe", f"Write `{near}`") if near else None,
            )
            yield from doubted(model, name, near, found)
