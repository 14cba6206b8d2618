"""C702 transmission-hwif-missing."""

from urdfkit.description.urdf.robot import Transmission
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.control.hardware_interfaces import has_gazebo_ros_control, is_old, misspelt_parts
from urdfkit.lint.finding import Edit, Fix, Severity
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class TransmissionInterfaceMissing(RobotRule):
    """A joint of a transmission has no hardware interface.

    ## What it does
    Checks for ``<joint>`` elements of transmissions without ``<hardwareInterface>``. The finding is an error if the
    robot uses gazebo_ros_control. Transmissions in the PR2 syntax, which have the type in an attribute, are not
    checked.

    ## Why is this bad?
    gazebo_ros_control has skipped such joints since ROS Indigo, and no longer reads a ``<hardwareInterface>`` inside
    ``<actuator>``.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
       <transmission name="elbow_transmission">
         <type>transmission_interface/SimpleTransmission</type>
    -    <joint name="elbow"/>
    -    <actuator name="elbow_motor">
    +    <joint name="elbow">
           <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
    -    </actuator>
    +    </joint>
    +    <actuator name="elbow_motor"/>
       </transmission>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix copies the interface that the actuator of the transmission names, which may not be the intended one.
    """

    code = "C702"
    name = "transmission-hwif-missing"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO | {"gz", "ros2"}

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint of a transmission without a hardware interface."""
        if not model.robot.transmissions or model.robot.ros2_control:
            return
        severity: Severity | None = "error" if has_gazebo_ros_control(model.robot) else None
        for transmission in model.robot.transmissions:
            for part in transmission.joints if not is_old(transmission) else ():
                is_misspelt = any(True for _ in misspelt_parts(part.element, "transmission/joint"))
                if not part.hardware_interfaces and not is_misspelt:
                    yield self.at(
                        model,
                        part.element,
                        f"transmission `{transmission.name or ''}` has no hardware interface "
                        f"for joint `{part.name or ''}`",
                        attribute="name",
                        joint=part.name,
                        help="add <hardwareInterface>hardware_interface/…JointInterface</hardwareInterface>",
                        severity=severity,
                        fix=_from_actuator(model, transmission, part.element),
                    )


def _from_actuator(model: Model, transmission: Transmission, joint: Element) -> Fix | None:
    names = [name for actuator in transmission.actuators for name in actuator.hardware_interfaces]
    position = joint.origin.position
    tag = model.tag(position)
    if not names or "$" in names[0] or tag is None or tag.name != "joint" or tag.children:
        return None
    source = model.document(position.file).source
    text = f"<hardwareInterface>{names[0]}</hardwareInterface>"
    if tag.close is not None:
        return Fix("unsafe", "Copy the interface of the actuator", (Edit(source.span(tag.end, tag.close), text),))
    end = len(source.text[: tag.end - 2].rstrip())
    return Fix("unsafe", "Copy the interface of the actuator", (Edit(source.span(end, tag.end), f">{text}</joint>"),))
