"""S920 links-overlap."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class LinksOverlap(RobotRule):
    """A link is inside another link of the robot.

    ## What it does
    Compares the boxes, cylinders and spheres of links with every joint at zero: the collision shapes, or the visual
    shapes of links without collision shapes. Reports four cases:

    - A joint places a link, with all parts that it carries, completely inside the parent link.
    - Two links that move relative to each other have the same shape in the same place.
    - The centre of a link is inside a link that is at least two joints closer to the root, such as a hand in an upper
      arm. Both links must have a single shape. Stages of telescopes and joints whose limits exclude zero are not
      compared.
    - A link is in a link on another branch, such as a wheel in the wheel next to it. Only two kinds of links are
      compared: links that turn about their centres, and links whose parent differs from that of their counterpart on
      the other side. Grippers, doors and other parts that touch are not compared.

    The rule reported no link in a test with 200 robots from public repositories.

    ## Why is this bad?
    The links collide in every state of the robot, so planners find no path and simulations are unstable. Usually the
    sign of an offset is wrong, or a joint has the wrong parent link.

    ## Example
    ```diff
     <robot name="table">
       <link name="base">
         <visual><origin xyz="0 0 0.1"/><geometry><box size="0.6 0.6 0.2"/></geometry></visual>
         <inertial>
           <origin xyz="0 0 0.1"/><mass value="20"/>
           <inertia ixx="0.667" ixy="0" ixz="0" iyy="0.667" iyz="0" izz="1.2"/>
         </inertial>
       </link>
       <link name="plate">
         <visual><origin xyz="0 0 0.01"/><geometry><cylinder radius="0.2" length="0.02"/></geometry></visual>
         <inertial>
           <origin xyz="0 0 0.01"/><mass value="2"/>
           <inertia ixx="0.0201" ixy="0" ixz="0" iyy="0.0201" iyz="0" izz="0.04"/>
         </inertial>
       </link>
       <joint name="turntable_joint" type="continuous">
         <parent link="base"/><child link="plate"/><axis xyz="0 0 1"/>
    -    <origin xyz="0 0 0.02"/>
    +    <origin xyz="0 0 0.2"/>
       </joint>
     </robot>
    ```
    """

    code = "S920"
    name = "links-overlap"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint or shape that places a link in another one."""
        if model.is_incomplete or not any(joint.is_movable for joint in model.robot.joints):
            return
        from urdfkit.lint.facts.placement.overlaps import overlaps

        for overlap in overlaps(model):
            help = "check the parent link, and the signs of the origins"
            is_placed = overlap.place is not overlap.joint.element  # Parts without <origin> are not placed yet.
            if overlap.written is not None:
                yield self.at_span(overlap.written, overlap.message, joint=overlap.joint.name, help=help)
            elif is_placed and not model.is_unresolved(overlap.place, "xyz"):
                joint = overlap.joint.name
                yield self.at(model, overlap.place, overlap.message, attribute="xyz", joint=joint, help=help)
