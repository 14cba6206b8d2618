"""E006 robot-name-missing."""

import re

from urdfkit.lint.fix_builders import more_attributes, new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class RobotNameMissing(RobotRule):
    """The robot has no name.

    ## What it does
    Checks that the ``<robot>`` element of a complete robot has a ``name``. Files that are only included need no name.

    ## Why is this bad?
    urdfdom rejects the robot: "No name given for the robot".

    ## Example
    ```diff
    -<robot>
    +<robot name="arm">
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe: the fix names the robot after its file, and no reference can depend on a missing name.
    """

    code = "E006"
    name = "robot-name-missing"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for a robot without a name."""
        robot = model.robot
        if robot.element.get("name") or robot.element.tag != "robot" or not robot.links or model.is_incomplete:
            return
        if any(
            name is not None and name not in robot.link_by_name
            for joint in robot.joints
            for name in (joint.parent, joint.child)
        ):
            return  # The file is a part of a robot: another file defines the missing links.
        name = re.sub(r"\W", "_", model.expanded.path.name.partition(".")[0]) or "robot"
        fix = (
            new_value(model, robot.element, "name", name, "safe", "Name the robot after its file")
            if "name" in robot.element.attributes
            else more_attributes(model, robot.element, f'name="{name}"', "safe", "Name the robot after its file")
        )
        yield self.at(model, robot.element, "the robot has no name", attribute="name", help='add name="…"', fix=fix)
