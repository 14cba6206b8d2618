"""C713 two-drivers-one-joint."""

from urdfkit.description.plugins import Parameter, PluginSpec
from urdfkit.description.urdf.robot import Robot
from urdfkit.lint.facts.control.hardware_interfaces import has_gazebo_ros_control
from urdfkit.lint.facts.gazebo.plugins import generations, plugins, spec_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class TwoDrivers(RobotRule):
    """A joint is driven by a controller and by another Gazebo plugin.

    ## What it does
    In robots with gazebo_ros_control, checks for joints with a transmission that are also moved by a drive plugin or a
    joint controller of the same Gazebo generation. Joints with a command interface in ``<ros2_control>`` are checked in
    the same way, if the hardware runs in Gazebo. Sensors and joint state publishers are accepted, because they only
    read joints.

    ## Why is this bad?
    The controller and the plugin both set the joint in every step, so the joint jerks or follows the last command of
    each step.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base_footprint"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_joint" type="continuous">
         <parent link="base_footprint"/>
         <child link="left"/>
         <origin xyz="0 0.15 0"/>
         <axis xyz="0 1 0"/>
       </joint>
       <joint name="right_joint" type="continuous">
         <parent link="base_footprint"/>
         <child link="right"/>
         <origin xyz="0 -0.15 0"/>
         <axis xyz="0 1 0"/>
       </joint>
    -  <transmission name="left_transmission">
    -    <type>transmission_interface/SimpleTransmission</type>
    -    <joint name="left_joint">
    -      <hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface>
    -    </joint>
    -    <actuator name="left_motor"/>
    -  </transmission>
       <gazebo>
    -    <plugin name="control" filename="libgazebo_ros_control.so"/>
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
            spec, simulators = spec_of(plugin, model.target), generations(plugin)
            both = [
                text
                for parameter in _driven_by(spec)
                for text, _ in values(plugin, parameter)
                if text in driven and driven[text][1] in simulators
            ]
            if both:
                message = f"`{', '.join(dict.fromkeys(both))}` is also driven by {driven[both[0]][0]}"
                help = "remove one of the two drivers"
                yield self.at(model, plugin.element, message, attribute="name", joint=both[0], help=help)


def _driven_by(spec: PluginSpec | None) -> tuple[Parameter, ...]:
    """Return the parameters that name joints which the plugin drives; sensors and publishers only read their joints."""
    from urdfkit.description.plugins.drives.table import DRIVES

    if spec is None or not (spec in DRIVES or spec.kind in ("joint_controller", "joint_position_controller")):
        return ()
    read = ("left_joint", "right_joint") if spec.kind == "tricycle" else ()  # The wheels with encoders.
    return tuple(each for each in spec.parameters if each.names == "joint" and each.meaning not in read)


def _controlled_joints(robot: Robot) -> dict[str, tuple[str, str]]:
    """Return the joints that controllers drive in Gazebo, each with its driver and the driver's generation."""
    drivers: dict[str, tuple[str, str]] = {}
    if robot.transmissions and has_gazebo_ros_control(robot):
        for transmission in robot.transmissions:
            drivers.update({part.name: ("gazebo_ros_control", "ros1") for part in transmission.joints if part.name})
    for block in robot.ros2_control:
        hardware = block.element.find("hardware")
        element = hardware.find("plugin") if hardware is not None else None
        text = element.text if element is not None else ""
        if text.startswith(("gazebo_ros2", "gz_ros2", "ign_ros2")):
            generation = "ros2" if text.startswith("gazebo_ros2") else "gz"
            for joint in block.element.find_all("joint"):
                if joint.find("command_interface") is not None:
                    drivers[joint.get("name") or ""] = ("ros2_control", generation)
    return drivers
