"""C704 hardware-interface-unprefixed."""

from urdfkit.lint.facts.control.hardware_interfaces import INTERFACES, PACKAGE, written
from urdfkit.lint.fix_builders import new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class HardwareInterfaceUnprefixed(RobotRule):
    """A hardware interface has no package prefix.

    ## What it does
    Checks for interfaces such as ``EffortJointInterface`` without the prefix ``hardware_interface/``. The interfaces of
    actuators are checked only if no joint of the transmission has an interface, because gazebo_ros_control ignores them
    otherwise.

    ## Why is this bad?
    gazebo_ros_control logs a deprecation warning at every start.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
       <transmission name="elbow_transmission">
         <type>transmission_interface/SimpleTransmission</type>
         <joint name="elbow">
    -      <hardwareInterface>EffortJointInterface</hardwareInterface>
    +      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
         </joint>
         <actuator name="elbow_motor"/>
       </transmission>
     </robot>
    ```

    ## Fix safety
    Safe: both forms name the same interface.
    """

    code = "C704"
    name = "hardware-interface-unprefixed"
    severity = "note"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each interface without its package prefix."""
        for text, element, transmission in written(model.robot):
            of_joints = [each for part in transmission.joints for each in part.element.find_all("hardwareInterface")]
            if text in INTERFACES and (element in of_joints or not of_joints):
                qualified = f"{PACKAGE}/{text}"
                message = f"hardware interface `{text}` has no package prefix; write `{qualified}`"
                yield self.at(model, element, message, fix=new_text(model, element, qualified, "safe"))
