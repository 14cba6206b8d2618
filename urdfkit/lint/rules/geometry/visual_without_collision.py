"""G610 visual-without-collision."""

from urdfkit.lint.facts.gazebo.drive_wheels import drives
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule


class VisualWithoutCollision(RobotRule):
    """A link has a visual but no collision shape.

    ## What it does
    Checks for links with ``<visual>`` and without ``<collision>``, in robots where other links have a ``<collision>``.
    The finding is a warning for wheels that a plugin drives.

    ## Why is this bad?
    In planners and simulators, other bodies pass through the link, and a wheel without collision shape sinks into the
    ground.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
         <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
         <collision><geometry><box size="0.3 0.2 0.1"/></geometry></collision>
       </link>
       <link name="mast">
         <inertial>
           <mass value="0.5"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.0001"/>
         </inertial>
         <visual><geometry><cylinder radius="0.02" length="0.5"/></geometry></visual>
    +    <collision><geometry><cylinder radius="0.02" length="0.5"/></geometry></collision>
       </link>
       <joint name="mount" type="fixed">
         <parent link="base"/>
         <child link="mast"/>
       </joint>
     </robot>
    ```
    """

    code = "G610"
    name = "visual-without-collision"
    severity = "note"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link without a collision shape, at its first visual."""
        if not any(link.collisions for link in model.robot.links):
            return
        driven = {wheel.joint.child for drive in drives(model) for wheel in (*drive.left, *drive.right)}
        for link in model.robot.links:
            if link.visuals and not link.collisions:
                message = f"link `{link.name}` has a visual but no collision shape"
                if link.name in driven:
                    message = f"driven wheel `{link.name}` has no collision shape and sinks into the ground"
                severity: Severity | None = "warning" if link.name in driven else None
                element = link.visuals[0].element
                yield self.at(model, element, message, link=link.name, help="add <collision>", severity=severity)
