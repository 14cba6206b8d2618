"""S906 double-offset."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class DoubleOffset(RobotRule):
    """Two consecutive fixed joints have the same offset.

    ## What it does
    Checks for a fixed joint with the same ``xyz`` as the fixed joint above it, if at least two components are nonzero.
    Movable joints are not checked, because equal segments of legs and arms are common.

    ## Why is this bad?
    The offset is applied twice, so the frame is twice as far away as intended. Usually one of the two offsets was
    copied by mistake.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="camera_link"/>
       <link name="camera_rgb_frame"/>
       <joint name="camera_joint" type="fixed">
         <parent link="base"/>
         <child link="camera_link"/>
         <origin xyz="0.38 0 0.2"/>
       </joint>
       <joint name="camera_rgb_joint" type="fixed">
         <parent link="camera_link"/>
         <child link="camera_rgb_frame"/>
    -    <origin xyz="0.38 0 0.2"/>
    +    <origin xyz="0 0.02 0"/>
       </joint>
     </robot>
    ```
    """

    code = "S906"
    name = "double-offset"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each repeated offset."""
        for joint in model.robot.joints:
            xyz = joint.origin.xyz
            if joint.type != "fixed" or sum(component != 0.0 for component in xyz) < 2:
                continue
            parents = model.robot.parents_of.get(joint.parent or "", [])
            if (
                len(parents) == 1
                and parents[0] is not joint
                and parents[0].type == "fixed"
                and parents[0].origin.xyz == xyz
            ):
                offset = " ".join(f"{component:g}" for component in xyz)
                place = joint.element.find("origin") or joint.element
                message = f"joint `{joint.name}` repeats the offset {offset} m of its parent joint `{parents[0].name}`"
                help = "remove one of the offsets unless both are intended"
                yield self.at(model, place, message, attribute="xyz", joint=joint.name, help=help)
