"""I512 collision-without-inertial."""

from urdfkit.lint.facts.gazebo.plugins import is_simulated
from urdfkit.lint.rule import Findings, Model, RobotRule


class CollisionWithoutInertial(RobotRule):
    """A link has a collision shape but no mass.

    ## What it does
    Checks for links with ``<collision>`` and without ``<inertial>`` that are fixed to another link. Robots without any
    mass are checked only if they are simulated.

    ## Why is this bad?
    Gazebo keeps such a link only if it merges the link into another link at a fixed joint.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
       </link>
       <link name="bumper">
    +    <inertial>
    +      <mass value="0.1"/>
    +      <inertia ixx="0.0002" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.0002"/>
    +    </inertial>
         <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
       </link>
       <joint name="mount" type="fixed">
         <parent link="base"/>
         <child link="bumper"/>
       </joint>
     </robot>
    ```
    """

    code = "I512"
    name = "collision-without-inertial"
    severity = "note"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each fixed link with a collision shape and without a mass."""
        robot = model.robot
        if model.is_incomplete:
            return  # The mass may be in the dropped part.
        if all(link.inertial is None for link in robot.links) and not is_simulated(model):
            return
        for link in robot.links:
            above = robot.parents_of.get(link.name, [])
            if link.collisions and link.inertial is None and above and all(joint.type == "fixed" for joint in above):
                message = f"link `{link.name}` has a collision shape but no mass"
                help = "add <inertial> with <mass> and <inertia>"
                yield self.at(model, link.collisions[0].element, message, link=link.name, help=help)
