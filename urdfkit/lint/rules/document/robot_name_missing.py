"""E006 robot-name-missing."""

from __future__ import annotations

import re

from urdfkit.lint.edits import more_attributes, new_value
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class RobotNameMissing(RobotRule):
    """The robot has no name.

    ## What it does
    Checks that the ``<robot>`` of a whole robot has a ``name``. Files that are only included need none.

    ## Why is this bad?
    urdfdom refuses it: "No name given for the robot".

    ## Example
    ```xml
    <robot>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
    </robot>
    ```

    ## Fix safety
    Safe: the name of the file becomes that of the robot, which nobody could have relied upon.
    """

    code = "E006"
    name = "robot-name-missing"
    fix = "safe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for a robot without name."""
        robot = model.robot
        if robot.element.get("name") or robot.element.tag != "robot" or not robot.links or model.is_incomplete:
            return
        if any(
            name is not None and name not in robot.link_by_name for j in robot.joints for name in (j.parent, j.child)
        ):
            return  # A part of a robot, which brings the missing links.
        name = re.sub(r"\W", "_", model.expanded.path.name.partition(".")[0]) or "robot"
        fix = (
            new_value(model, robot.element, "name", name, "safe", "Name the robot after its file")
            if "name" in robot.element.attributes
            else more_attributes(model, robot.element, f'name="{name}"', "safe", "Name the robot after its file")
        )
        yield self.at(model, robot.element, "the robot has no name", attribute="name", help='add name="…"', fix=fix)
