"""T207 duplicate-joint."""

from urdfkit.description.urdf.queries import repeated
from urdfkit.lint.rule import Findings, Model, RobotRule


class DuplicateJoint(RobotRule):
    """Two joints have the same name.

    ## What it does
    Checks for joints with the name of an earlier joint.

    ## Why is this bad?
    Other elements and tools identify a joint by its name. urdfdom rejects the robot; other tools keep one of the two
    joints.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="upper"/>
       <link name="hand"/>
    -  <joint name="wrist" type="fixed"><parent link="base"/><child link="upper"/></joint>
    +  <joint name="shoulder" type="fixed"><parent link="base"/><child link="upper"/></joint>
       <joint name="wrist" type="fixed"><parent link="upper"/><child link="hand"/></joint>
     </robot>
    ```
    """

    code = "T207"
    name = "duplicate-joint"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with the name of an earlier one."""
        for joint, first in repeated(model.robot.joints):
            message = f"duplicate joint `{joint.name}`"
            help = f"rename or remove it; the first definition is at {model.shown(first.element.origin.position)}"
            yield self.at(model, joint.element, message, attribute="name", joint=joint.name, help=help)
