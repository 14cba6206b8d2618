"""M103 srdf-of-other-robot."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class SrdfOfOtherRobot(RobotRule):
    """An SRDF and the URDF have different robot names.

    ## What it does
    Compares the names in ``<robot name="…">`` if most links and joints in the SRDF exist in the robot. Nothing is
    reported if another description in these packages has the robot name of the SRDF.

    ## Why is this bad?
    MoveIt logs "Semantic description is not specified for the same robot as the URDF".

    ## Example
    ```diff
    -<robot name="amr">
    +<robot name="arm">
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
        from urdfkit.lint.facts.moveit.srdf import semantics_of, severity_for

        robot = model.robot
        for root in semantics_of(model):
            if root.get("name") != robot.name:
                message = f"the SRDF is for robot `{root.get('name') or ''}`, but the URDF is robot `{robot.name}`"
                severity, help = severity_for(root, model), f'write name="{robot.name}"'
                yield self.at(model, root, message, attribute="name", help=help, severity=severity)
