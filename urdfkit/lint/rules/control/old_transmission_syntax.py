"""C706 old-transmission-syntax."""

from urdfkit.lint.facts.control.hardware_interfaces import is_old
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class OldTransmissionSyntax(RobotRule):
    """A transmission uses the obsolete syntax of the PR2.

    ## What it does
    Checks for ``<transmission type="…">`` without a ``<type>`` element.

    ## Why is this bad?
    ros_control and gazebo_ros_control read only the ``<type>`` element and skip the transmission.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
    -  <transmission name="elbow_transmission" type="pr2_mechanism_model/SimpleTransmission">
    -    <actuator name="elbow_motor"/>
    -    <joint name="elbow"/>
    -    <mechanicalReduction>10</mechanicalReduction>
    +  <transmission name="elbow_transmission">
    +    <type>transmission_interface/SimpleTransmission</type>
    +    <joint name="elbow">
    +      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
    +    </joint>
    +    <actuator name="elbow_motor">
    +      <mechanicalReduction>10</mechanicalReduction>
    +    </actuator>
       </transmission>
     </robot>
    ```
    """

    code = "C706"
    name = "old-transmission-syntax"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each transmission in the obsolete syntax."""
        for transmission in model.robot.transmissions:
            if is_old(transmission):
                message = f"transmission `{transmission.name or ''}` uses an obsolete syntax: "
                message += "ros_control reads <type>, not type="
                help = "replace the attribute with <type>transmission_interface/SimpleTransmission</type>"
                yield self.at(model, transmission.element, message, attribute="type", help=help)
