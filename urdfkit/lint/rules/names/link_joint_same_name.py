"""N301 link-joint-same-name."""

from urdfkit.lint.facts.gazebo.plugins import is_simulated
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule


class LinkJointSameName(RobotRule):
    """A joint and a link have the same name.

    ## What it does
    Checks for joints that have the name of a link. Without a target, the finding is a note if the robot has no plugins
    or sensors of Gazebo, because such a robot may never be converted to SDF.

    ## Why is this bad?
    URDF allows this, but in SDF links and joints share one namespace. Gazebo rejects the model ("non-unique name") or
    renames the joint, and plugins that refer to the joint do not find it.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="wheel"/>
    -  <joint name="wheel" type="fixed">
    +  <joint name="wheel_joint" type="fixed">
         <parent link="base"/>
         <child link="wheel"/>
       </joint>
     </robot>
    ```
    """

    code = "N301"
    name = "link-joint-same-name"
    severity = "warning"
    not_for = frozenset(("mujoco", "isaac", "moveit", "ros1", "ros2"))

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with the name of a link."""
        may_become_sdf = model.target is not None or is_simulated(model)
        for joint in model.robot.joints:
            link = model.robot.link_by_name.get(joint.name)
            if link is not None and joint.name:
                message = f"joint `{joint.name}` has the same name as a link, which SDF does not allow"
                help = f"rename the joint to `{joint.name}_joint`; "
                help += f"the link is at {model.shown(link.element.origin.position)}"
                severity: Severity | None = None if may_become_sdf else "note"
                yield self.at(
                    model, joint.element, message, attribute="name", joint=joint.name, help=help, severity=severity
                )
