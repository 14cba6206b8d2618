"""C703 hardware-interface-unknown."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.urdf.robot import Transmission
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.control.hardware_interfaces import (
    INTERFACES,
    PACKAGE,
    has_default_hardware,
    has_gazebo_ros_control,
    is_old,
    written,
)
from urdfkit.lint.fix_builders import nearest, new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class HardwareInterfaceUnknown(RobotRule):
    """A transmission names an unknown hardware interface.

    ## What it does
    Checks for ``<hardwareInterface>`` values that nearly match an interface of the hardware_interface package.
    Interfaces of other packages are accepted. If the robot uses gazebo_ros_control, the rule also reports, as notes,
    the transmissions that the default hardware of gazebo_ros_control does not simulate. These transmissions have
    several joints, or an interface other than position, velocity or effort.

    ## Why is this bad?
    The transmission fails to load with "No suitable hardware interface", and controllers for the joint do not start.
    `urdfkit sim` ignores the transmission.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
       <transmission name="elbow_transmission">
         <type>transmission_interface/SimpleTransmission</type>
         <joint name="elbow">
    -      <hardwareInterface>hardware_interface/EffortJoinInterface</hardwareInterface>
    +      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
         </joint>
         <actuator name="elbow_motor"/>
       </transmission>
     </robot>
    ```

    ## Fix safety
    Safe: the name differs from a known interface by only one or two letters.
    """

    code = "C703"
    name = "hardware-interface-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt interface, and for each transmission that Gazebo does not simulate."""
        misspelt = set()
        for text, element, _ in written(model.robot):
            package, slash, name = text.rpartition("/")
            if name in INTERFACES and package in ("", PACKAGE):
                continue
            match = name if name in INTERFACES else nearest(name, INTERFACES, cutoff=0.85)
            if match is None or (slash and package != PACKAGE and nearest(package, [PACKAGE], cutoff=0.7) is None):
                continue
            qualified = f"{PACKAGE}/{match}"
            misspelt.add(element)
            message = f"unknown hardware interface `{text}`" + Suggestion(qualified, text)
            yield self.at(model, element, message, fix=new_text(model, element, qualified, "safe"))
        is_simulated = has_default_hardware(model.robot) or (
            model.target == "urdfkit" and has_gazebo_ros_control(model.robot)
        )
        for transmission in model.robot.transmissions if is_simulated else ():
            yield from self._not_simulated(model, transmission, misspelt)

    def _not_simulated(self, model: Model, transmission: Transmission, misspelt: set[Element]) -> Findings:
        from urdfkit.description.control.ros1_controllers import SIMULATED_INTERFACES

        if is_old(transmission):
            return
        simulator = "the default hardware of gazebo_ros_control" if has_default_hardware(model.robot) else "urdfkit"
        effect = f"{simulator} does not simulate it"
        if len(transmission.joints) != 1:
            message = f"transmission `{transmission.name or ''}` has {len(transmission.joints)} joints; {effect}"
            yield self.at(model, transmission.element, message, attribute="name", severity="note")
            return
        interface = transmission.joints[0].element.find("hardwareInterface")
        if interface is None or interface in misspelt or not interface.text or "$" in interface.text:
            return
        if interface.text.removeprefix(f"{PACKAGE}/") not in SIMULATED_INTERFACES:
            message = f"transmission `{transmission.name or ''}` has the interface `{interface.text}`; {effect}"
            yield self.at(model, interface, message, severity="note")
