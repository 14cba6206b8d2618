"""J427 joint-off-its-parent."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class JointOffItsParent(RobotRule):
    """A joint is outside or inside its parent link, although all other joints are on the surface of their parent links.

    ## What it does
    Compares the positions of ``revolute`` and ``prismatic`` joints, and of fixed joints that carry them, with the
    bounding boxes of their parent links. Joints that steer wheels, and fixed joints in the middle of their child links,
    are not compared. Reports a joint that is outside the box, or so deep inside it that its child link is inside the
    parent link, if at least four other joints are exactly on the surface of the boxes of their parent links. A
    telescope stage on a prismatic joint may be inside.

    Also reports a joint on the axis of a slender link that is not at the end of this link, if it is the only such joint
    and two other joints are at the ends of slender links. A joint that is as far along its parent link as its child
    link is long, or at the end with the opposite sign, is always reported. Fixed joints are reported if their links are
    apart, but would meet exactly with the opposite sign of one coordinate.

    ## Why is this bad?
    The child link floats or is sunk in its parent link, and all frames further along the chain are misplaced. Usually
    the offset was computed with the length of another link, or the joint has the wrong parent link.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="tube" params="name">
         <link name="${name}">
           <visual><origin xyz="0 0 0.1"/><geometry><cylinder radius="0.03" length="0.2"/></geometry></visual>
           <inertial>
             <origin xyz="0 0 0.1"/><mass value="1"/>
             <inertia ixx="0.0036" ixy="0" ixz="0" iyy="0.0036" iyz="0" izz="0.00045"/>
           </inertial>
         </link>
       </xacro:macro>
       <xacro:tube name="base"/>
       <xacro:tube name="link_1"/>
       <xacro:tube name="link_2"/>
       <xacro:tube name="link_3"/>
       <xacro:tube name="link_4"/>
       <xacro:tube name="link_5"/>
       <joint name="joint_1" type="revolute">
         <parent link="base"/><child link="link_1"/><axis xyz="0 0 1"/>
         <origin xyz="0 0 0.2"/>
         <limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
       <joint name="joint_2" type="revolute">
         <parent link="link_1"/><child link="link_2"/><axis xyz="0 1 0"/>
         <origin xyz="0 0 0.2"/>
         <limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
       <joint name="joint_3" type="revolute">
         <parent link="link_2"/><child link="link_3"/><axis xyz="0 0 1"/>
    -    <origin xyz="0 0 0.25"/>
    +    <origin xyz="0 0 0.2"/>
         <limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
       <joint name="joint_4" type="revolute">
         <parent link="link_3"/><child link="link_4"/><axis xyz="0 1 0"/>
         <origin xyz="0 0 0.2"/>
         <limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
       <joint name="joint_5" type="revolute">
         <parent link="link_4"/><child link="link_5"/><axis xyz="0 0 1"/>
         <origin xyz="0 0 0.2"/>
         <limit lower="-1" upper="1" effort="10" velocity="1"/>
       </joint>
     </robot>
    ```
    """

    code = "J427"
    name = "joint-off-its-parent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for the only joint that is not at the surface of its parent link."""
        from urdfkit.lint.facts.placement.joint_places import misplaced, on_wrong_side
        from urdfkit.lint.facts.placement.tube_ends import along_tubes

        if model.is_incomplete:
            return
        found: set[str] = set()
        for place in misplaced(model):
            joint = place.joint
            where = f"{-place.depth:.3g} m outside" if place.depth < 0.0 else f"{place.depth:.3g} m inside"
            message = f"joint `{joint.name}` is {where} its parent link `{joint.parent}`; "
            message += "all other joints are on the surface of their parent links"
            help = "check the parent link and the origin"
            names = tuple(name for name in (joint.child, joint.parent) if name)
            found.add(joint.name)
            yield self.at(model, place.element, message, attribute="xyz", joint=joint.name, help=help, names=names)
        for each in along_tubes(model):
            joint = each.joint
            if joint.name not in found:
                message = f"joint `{joint.name}` is at {each.place:.3g} m along `{joint.parent}`, "
                message += f"not at the end of the link, {each.length:.3g} m"
                help = "check the length from which the origin is computed"
                help = "check the sign of the origin" if each.place < 0.0 else help
                names = tuple(name for name in (joint.child, joint.parent) if name)
                yield self.at(model, each.element, message, attribute="xyz", joint=joint.name, help=help, names=names)
                found.add(joint.name)
        for joint, gap, k in on_wrong_side(model):
            if joint.name not in found:
                found.add(joint.name)
                message = f"link `{joint.child}` is {gap:.3g} m away from its parent link `{joint.parent}`; "
                message += f"with the opposite sign of {'xyz'[k]} it starts where its parent ends"
                element = joint.element.find("origin") or joint.element
                names = tuple(name for name in (joint.child, joint.parent) if name)
                help = "check the sign of the coordinate"
                yield self.at(model, element, message, attribute="xyz", joint=joint.name, help=help, names=names)
