"""T206 duplicate-link."""

from __future__ import annotations

from urdfkit.description.queries import repeated
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class DuplicateLink(RobotRule):
    """Two links have the same name.

    ## What it does
    Looks for links that carry the name of an earlier one.

    ## Why is this bad?
    Names are how everything refers to a link. urdfdom refuses the robot; tools that do not, keep either of the two.

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

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each link whose name is taken."""
        for link, first in repeated(model.robot.links):
            yield self.at(
                model,
                link.element,
                f"link `{link.name}` is there already",
                attribute="name",
                link=link.name,
                help=f"the first is at {model.shown(first.element.origin.position)}",
            )
