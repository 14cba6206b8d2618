"""C713 two-drivers-one-joint."""

from urdfkit.description.urdf.robot import Robot
from urdfkit.lint.facts.control.hardware_interfaces import has_gazebo_ros_control
from urdfkit.lint.facts.gazebo.plugins import plugins, spec_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class TwoDrivers(RobotRule):
    """A joint is driven by a controller and by another Gazebo plugin.

    ## What it does
    Checks for joints that have a transmission, in robots with gazebo_ros_control, and that another plugin also drives.
    The same applies to joints with a command interface in ``<ros2_control>`` if its hardware runs in Gazebo.

    ## Why is this bad?
    Both set the joint in every step, so the joint jerks or follows the plugin that runs last.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="fixed">
        <parent link="base_footprint"/>
        <child link="left"/>
        <origin xyz="0 0.15 0"/>
      </joint>
      <joint name="right_joint" type="fixed">
        <parent link="base_footprint"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0"/>
      </joint>
      <transmission name="left_transmission">
        <type>transmission_interface/SimpleTransmission</type>
        <joint name="left_joint">
          <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface>
        </joint>
        <actuator name="left_motor"/>
      </transmission>
      <gazebo>
        <plugin name="control" filename="libgazebo_ros_control.so"/>
        <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
          <leftJoint>left_joint</leftJoint>
          <rightJoint>right_joint</rightJoint>
          <wheelSeparation>0.3</wheelSeparation>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base_footprint"/>
      <link name="left"/>
      <link name="right"/>
      <joint name="left_joint" type="fixed">
        <parent link="base_footprint"/>
        <child link="left"/>
        <origin xyz="0 0.15 0"/>
      </joint>
      <joint name="right_joint" type="fixed">
        <parent link="base_footprint"/>
        <child link="right"/>
        <origin xyz="0 -0.15 0"/>
      </joint>
      <gazebo>
        <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
          <leftJoint>left_joint</leftJoint>
          <rightJoint>right_joint</rightJoint>
          <wheelSeparation>0.3</wheelSeparation>
        </plugin>
      </gazebo>
    </robot>
    ```
    """

    code = "C713"
    name = "two-drivers-one-joint"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each plugin that drives joints of a controller."""
        from urdfkit.description.plugins import values

        driven = _controlled_joints(model.robot)
        if not driven:
            return
        for plugin, _, _ in plugins(model.robot):
            spec = spec_of(plugin, model.target)
            if spec is None or spec.kind == "joint_state_publisher":
                continue
            both = [
                text
                for parameter in spec.parameters
                if parameter.names == "joint"
                for text, _ in values(plugin, parameter)
                if text in driven
            ]
            if both:
                yield self.at(
                    model,
                    plugin.element,
                    f"`{', '.join(dict.fromkeys(both))}` is also driven by {driven[both[0]]}",
                    attribute="name",
                    joint=both[0],
                    help="remove one of the two drivers",
                )


def _controlled_joints(robot: Robot) -> dict[str, str]:
    """Return the joints that controllers drive in Gazebo, each with the name of its driver."""
    drivers: dict[str, str] = {}
    if robot.transmissions and has_gazebo_ros_control(robot):
        for transmission in robot.transmissions:
            drivers.update({part.name: "gazebo_ros_control" for part in transmission.joints if part.name})
    for block in robot.ros2_control:
        hardware = block.element.find("hardware")
        element = hardware.find("plugin") if hardware is not None else None
        if element is not None and element.text.startswith(("gazebo_ros2", "gz_ros2", "ign_ros2")):
            for joint in block.element.find_all("joint"):
                if joint.find("command_interface") is not None:
                    drivers[joint.get("name") or ""] = "ros2_control"
    return drivers
