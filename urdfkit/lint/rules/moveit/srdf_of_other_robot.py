"""M103 srdf-of-other-robot."""

import re

from urdfkit.lint.rule import Findings, Model, RobotRule

_SHARE = 0.8
"""Smallest proportion of existing links and joints in the references of an SRDF for the robot."""


class SrdfOfOtherRobot(RobotRule):
    """The robot name of an SRDF differs from that of the URDF.

    ## What it does
    Compares the names in ``<robot name="…">`` if most links and joints in the SRDF exist in the robot. Nothing is
    reported if a description in these packages has the name of the SRDF.

    ## Why is this bad?
    MoveIt logs "Semantic description is not specified for the same robot as the URDF".

    ## Example
    ```xml
    <robot name="amr">
      <group name="arm">
        <joint name="elbow"/>
      </group>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <group name="arm">
        <joint name="elbow"/>
      </group>
    </robot>
    ```
    """

    code = "M103"
    name = "srdf-of-other-robot"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each SRDF of this robot that names another robot."""
        from urdfkit.lint.facts.moveit.srdf import fits, robot_names, severity_for

        robot = model.robot
        others = [root for root in model.semantic_roots.values() if root.get("name") != robot.name]
        names: list[str] | None = None
        for root in others if robot.links and robot.name else ():
            if not fits(root, robot, _SHARE):
                continue
            names = robot_names(model) if names is None else names
            name = root.get("name")
            if name is None or not any(re.fullmatch(pattern, name) for pattern in names):
                message = f"the SRDF is for robot `{name or ''}`, but the URDF is robot `{robot.name}`"
                severity, help = severity_for(root, model), f'write name="{robot.name}"'
                yield self.at(model, root, message, attribute="name", help=help, severity=severity)
