"""Z819 fixed-joint-lumping-hazard."""

from urdfkit.lint.facts.gazebo.plugins import lumped, plugins
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_BODIES = frozenset(("body_name", "linkName", "link_name"))
"""Plugin parameters that name a link; sdformat itself updates ``bodyName`` and ``frameName`` (parser_urdf.cc)."""


class FixedJointLumping(RobotRule):
    """A plugin or force-torque sensor uses a link or joint that Gazebo merges away at a fixed joint.

    ## What it does
    Checks links that plugins name (``body_name``, ``linkName`` …), and joints with a force-torque sensor. Reports child
    links of fixed joints, and fixed joints, unless ``preserveFixedJoint`` or ``disableFixedJointLumping`` keeps the
    joint. ``bodyName`` is not checked, because sdformat updates it.

    ## Why is this bad?
    Gazebo merges the child link of a fixed joint into its parent link. The model then has no link or joint of that
    name, and the plugin stops.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="imu"/>
       <joint name="imu_joint" type="fixed"><parent link="base"/><child link="imu"/></joint>
    +  <gazebo reference="imu_joint">
    +    <preserveFixedJoint>true</preserveFixedJoint>
    +  </gazebo>
       <gazebo>
         <plugin name="truth" filename="libgazebo_ros_p3d.so">
           <body_name>imu</body_name>
         </plugin>
       </gazebo>
     </robot>
    ```
    """

    code = "Z819"
    name = "fixed-joint-lumping-hazard"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each use of a link or joint that Gazebo merges away."""
        merged = lumped(model.robot)
        if not merged:
            return
        for plugin, _, _ in plugins(model.robot):
            for child in plugin.element.children:
                if child.tag in _BODIES and child.text in merged:
                    message = f"<{child.tag}> names `{child.text}`, which Gazebo merges into its parent link"
                    help = "set <preserveFixedJoint> to true in a <gazebo> block of its joint"
                    yield self.at(model, child, message, link=child.text, help=help)
        for block in model.robot.gazebo:
            joint = model.robot.joint_by_name.get(block.reference or "")
            for sensor in block.sensors:
                if (
                    joint is not None
                    and sensor.type == "force_torque"
                    and joint.child in merged
                    and joint.type == "fixed"
                ):
                    message = f"joint `{joint.name}` is fixed: Gazebo removes it together with its force-torque sensor"
                    help = "set <preserveFixedJoint> to true in this block"
                    yield self.at(model, sensor.element, message, joint=joint.name, help=help)
