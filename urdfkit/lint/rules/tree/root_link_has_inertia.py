"""T210 root-link-has-inertia."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class RootLinkHasInertia(RobotRule):
    """The root link has an inertia, which KDL does not support.

    ## What it does
    With ``--target ros1`` or ``--target ros2``, checks for a mass on the root link.

    ## Why is this bad?
    robot_state_publisher logs a warning at every start, and dynamics computed with KDL ignore the mass. Simulators use
    the mass, and a floating base requires it. Therefore, the finding is only a note, and the rule applies only to ROS.

    ## Example
    ```diff
     <robot name="arm">
    +  <link name="base_footprint"/>
    +  <joint name="base_joint" type="fixed">
    +    <parent link="base_footprint"/>
    +    <child link="base_link"/>
    +  </joint>
       <link name="base_link">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
       </link>
     </robot>
    ```
    """

    code = "T210"
    name = "root-link-has-inertia"
    severity = "note"
    only_for = ("ros1", "ros2")

    def check(self, model: Model) -> Findings:
        """Yield a finding for a root link with a mass."""
        roots = model.robot.roots()
        if len(roots) == 1 and "$" not in roots[0].name and roots[0].inertial is not None and roots[0].inertial.mass:
            message = f"root link `{roots[0].name}` has an inertia, which KDL ignores"
            help = "add an empty root link, such as base_footprint, and connect it with a fixed joint"
            yield self.at(model, roots[0].element, message, attribute="name", link=roots[0].name, help=help)
