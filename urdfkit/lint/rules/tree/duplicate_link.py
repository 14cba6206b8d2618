"""T206 duplicate-link."""

from urdfkit.description.urdf.queries import repeated
from urdfkit.lint.rule import Findings, Model, RobotRule


class DuplicateLink(RobotRule):
    """Two links have the same name.

    ## What it does
    Checks for links with the name of an earlier link.

    ## Why is this bad?
    Other elements and tools identify a link by its name. urdfdom rejects the robot; other tools keep one of the two
    links.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="upper"/>
      <link name="upper"/>
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

    code = "T206"
    name = "duplicate-link"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link with the name of an earlier one."""
        for link, first in repeated(model.robot.links):
            yield self.at(
                model,
                link.element,
                f"duplicate link `{link.name}`",
                attribute="name",
                link=link.name,
                help=f"rename or remove it; the first definition is at {model.shown(first.element.origin.position)}",
            )
