"""S921 joint-moves-into-robot."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class JointMovesIntoRobot(RobotRule):
    """A joint moves its load into the robot or the ground, and would not do so in the opposite direction.

    ## What it does
    Checks ``revolute`` and ``prismatic`` joints whose range is mainly on one side of zero, with all other joints at
    zero. Reports a joint if the parts that it carries enter the rest of the robot, or reach below the lowest point of
    the robot, in at least half of the range but nowhere in the mirrored range. Only boxes, cylinders and spheres are
    compared. The rule reported no joint in a test with 200 robots from public repositories.

    ## Why is this bad?
    A lid opens into its box, or a lift sinks into its column. The usual cause is a wrong sign of the axis or of the
    limits.

    ## Example
    ```diff
     <robot name="box">
       <link name="base">
         <visual><origin xyz="0 0 0.2"/><geometry><box size="0.4 0.4 0.4"/></geometry></visual>
         <inertial>
           <origin xyz="0 0 0.2"/><mass value="5"/>
           <inertia ixx="0.133" ixy="0" ixz="0" iyy="0.133" iyz="0" izz="0.133"/>
         </inertial>
       </link>
       <link name="lid">
         <visual><origin xyz="0.2 0 0.01"/><geometry><box size="0.4 0.4 0.02"/></geometry></visual>
         <inertial>
           <origin xyz="0.2 0 0.01"/><mass value="1"/>
           <inertia ixx="0.0134" ixy="0" ixz="0" iyy="0.0134" iyz="0" izz="0.0267"/>
         </inertial>
       </link>
       <joint name="lid_joint" type="revolute">
         <parent link="base"/><child link="lid"/><origin xyz="-0.2 0 0.4"/>
    -    <axis xyz="0 1 0"/>
    +    <axis xyz="0 -1 0"/>
         <limit lower="0" upper="1.5" effort="10" velocity="1"/>
       </joint>
     </robot>
    ```
    """

    code = "S921"
    name = "joint-moves-into-robot"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint that is blocked in its range only."""
        if model.is_incomplete:
            return
        from urdfkit.lint.facts.placement.blocked_joints import blocked_joints

        for joint, link in blocked_joints(model):
            place = joint.element.find("axis") or joint.element
            into = f"link `{link}`" if link else "the ground"
            message = f"joint `{joint.name}` moves `{joint.child}` into {into}; "
            message += "in the opposite direction it would move freely"
            help = "check the signs of <axis> and of the limits"
            if not any(model.is_unresolved(each) for each in joint.element.walk()):
                yield self.at(model, place, message, attribute="xyz", joint=joint.name, help=help)
