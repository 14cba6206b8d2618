"""S918 tool-frame-inside-body."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class ToolFrameInsideBody(RobotRule):
    """The frame of a tool is inside the gripper, or a camera next to the tool faces the arm.

    ## What it does
    Checks frames without shapes that are fixed to a link with fingers and have ``tcp``, ``tool``, ``grasp``, ``tip`` or
    ``end_effector`` in their names. Reports a frame that is inside a box or cylinder of that link, or not on the side
    of the fingers. Also reports the optical frame of a camera on the last link of an arm, if the z axis of the frame
    points away from the fingers or the tool.

    ## Why is this bad?
    The gripper collides with objects at the planned pose, or the camera sees the arm instead of the object. Usually the
    offset was copied from another link, or an angle has the wrong sign.

    ## Example
    ```diff
     <robot name="gripper">
       <link name="palm">
         <visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual>
         <inertial>
           <mass value="0.5"/>
           <inertia ixx="0.000833" ixy="0" ixz="0" iyy="0.000833" iyz="0" izz="0.000833"/>
         </inertial>
       </link>
       <link name="finger">
         <inertial>
           <mass value="0.05"/>
           <inertia ixx="1.54e-05" ixy="0" ixz="0" iyy="1.67e-05" iyz="0" izz="2.08e-06"/>
         </inertial>
       </link>
       <link name="tcp"/>
       <joint name="finger_joint" type="prismatic">
         <parent link="palm"/><child link="finger"/>
         <origin xyz="0 0.01 0.08"/>
         <axis xyz="0 1 0"/>
         <limit lower="0" upper="0.03" effort="20" velocity="0.2"/>
       </joint>
       <joint name="tcp_joint" type="fixed">
         <parent link="palm"/><child link="tcp"/>
    -    <origin xyz="0 0 0.03"/>
    +    <origin xyz="0 0 0.1"/>
       </joint>
     </robot>
    ```
    """

    code = "S918"
    name = "tool-frame-inside-body"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each frame and camera, at the origin of its joint."""
        from urdfkit.lint.facts.placement.tools import cameras_looking_back, tools_behind, tools_inside

        if model.is_damaged:
            return
        for joint, depth in tools_inside(model):
            message = f"frame `{joint.child}` is {depth:.3g} m inside the shape of link `{joint.parent}`"
            place = joint.element.find("origin") or joint.element
            help = "move it to the tips of the fingers"
            yield self.at(model, place, message, attribute="xyz", joint=joint.name, help=help)
        for joint, is_behind in tools_behind(model):
            message = f"frame `{joint.child}` is next to link `{joint.parent}`, whose fingers are on another side"
            if is_behind:
                message = f"frame `{joint.child}` is behind link `{joint.parent}`, whose fingers are on the other side"
            place = joint.element.find("origin") or joint.element
            help = "move it to the tips of the fingers"
            yield self.at(model, place, message, attribute="xyz", joint=joint.name, help=help)
        for joint, frame in cameras_looking_back(model):
            message = f"camera `{joint.child}` faces the arm instead of the tool"
            place = joint.element.find("origin") or joint.element
            help = "check the rpy of the origin"
            yield self.at(model, place, message, attribute="rpy", joint=joint.name, help=help, names=(frame,))
