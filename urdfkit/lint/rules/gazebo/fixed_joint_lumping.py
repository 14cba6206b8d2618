"""Z819 fixed-joint-lumping-hazard."""

from __future__ import annotations

from urdfkit.lint.gazebo import lumped, plugins
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_BODIES = frozenset(("body_name", "linkName", "link_name"))
"""``bodyName`` and ``frameName`` sdformat replaces itself (parser_urdf.cc, ReduceSDFExtensionPluginFrameReplace)."""


class FixedJointLumping(RobotRule):
    """A plugin, or a force-torque sensor, needs a link or joint that Gazebo dissolves.

    ## What it does
    Looks for bodies that plugins name (``body_name``, ``linkName`` …; sdformat mends ``bodyName`` itself) and
    force-torque sensors on joints, where the joint is fixed and neither ``preserveFixedJoint`` nor
    ``disableFixedJointLumping`` keeps it.

    ## Why is this bad?
    Gazebo makes a link behind a fixed joint part of the link before it: there is no body, and no joint, of that
    name any more, and the plugin stops.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="imu"/>
      <joint name="imu_joint" type="fixed"><parent link="base"/><child link="imu"/></joint>
      <gazebo>
        <plugin name="truth" filename="libgazebo_ros_p3d.so">
          <body_name>imu</body_name>
          <update_rate>50</update_rate>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="imu"/>
      <joint name="imu_joint" type="fixed"><parent link="base"/><child link="imu"/></joint>
      <gazebo reference="imu_joint">
        <preserveFixedJoint>true</preserveFixedJoint>
      </gazebo>
      <gazebo>
        <plugin name="truth" filename="libgazebo_ros_p3d.so">
          <body_name>imu</body_name>
          <update_rate>50</update_rate>
        </plugin>
      </gazebo>
    </robot>
    ```
    """

    code = "Z819"
    name = "fixed-joint-lumping-hazard"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each body or joint that will not be there."""
        gone = lumped(model.robot)
        if not gone:
            return
        for plugin, _, _ in plugins(model.robot):
            for child in plugin.element.children:
                if child.tag in _BODIES and child.text in gone:
                    yield self.at(
                        model,
                        child,
                        f"<{child.tag}> names `{child.text}`, which Gazebo makes part of the link before it",
                        link=child.text,
                        help="set preserveFixedJoint in a <gazebo reference> of its joint",
                    )
        for block in model.robot.gazebo:
            joint = model.robot.joint_by_name.get(block.reference or "")
            for sensor in block.sensors:
                if (
                    joint is not None
                    and sensor.type == "force_torque"
                    and joint.child in gone
                    and joint.type == "fixed"
                ):
                    yield self.at(
                        model,
                        sensor.element,
                        f"joint `{joint.name}` is fixed: Gazebo dissolves it, and the force-torque sensor on it",
                        joint=joint.name,
                        help="set preserveFixedJoint in this block",
                    )
