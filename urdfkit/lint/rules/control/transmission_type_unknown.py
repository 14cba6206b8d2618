"""C715 transmission-type-unknown."""

from collections.abc import Iterator

from urdfkit.defect_message import Suggestion
from urdfkit.description.xml.element import Element
from urdfkit.lint.fix_builders import nearest, new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_PACKAGE = "transmission_interface"
_TYPES = ("SimpleTransmission", "DifferentialTransmission", "FourBarLinkageTransmission")
"""The classes of transmission_interface, the same in ros_control and ros2_control."""


_MAX_LENGTH_DIFFERENCE = 2
"""Largest accepted difference in length from the suggested type."""


class TransmissionTypeUnknown(RobotRule):
    """A transmission has an unknown type.

    ## What it does
    Checks the ``<type>`` of transmissions, and the ``<plugin>`` of transmissions in ``<ros2_control>``, for names that
    nearly match a class of transmission_interface. Transmissions of other packages are accepted.

    ## Why is this bad?
    pluginlib does not find the class, so the hardware does not load its transmissions.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
       <transmission name="elbow_transmission">
    -    <type>transmission_interface/SimpleTransmision</type>
    +    <type>transmission_interface/SimpleTransmission</type>
         <joint name="elbow">
           <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
         </joint>
         <actuator name="elbow_motor"/>
       </transmission>
     </robot>
    ```

    ## Fix safety
    Safe: the name differs from a known class by only one or two letters.
    """

    code = "C715"
    name = "transmission-type-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt transmission type."""
        for element in _type_elements(model):
            package, slash, name = element.text.rpartition("/")
            suggestion = name if name in _TYPES else nearest(name, _TYPES, cutoff=0.85)
            is_standard = not slash or package == _PACKAGE or nearest(package, [_PACKAGE], cutoff=0.8) is not None
            qualified = f"{_PACKAGE}/{suggestion}"
            if suggestion is None or not is_standard or element.text in (qualified, suggestion):
                continue
            if abs(len(name) - len(suggestion)) > _MAX_LENGTH_DIFFERENCE:
                continue  # A type of another package, such as `HalfDifferentialTransmission` of PAL Robotics.
            message = f"unknown transmission type `{element.text}`" + Suggestion(qualified, element.text)
            yield self.at(model, element, message, fix=new_text(model, element, qualified, "safe"))


def _type_elements(model: Model) -> Iterator[Element]:
    """Yield the elements that name the type of a transmission."""
    parents = [(transmission.element, "type") for transmission in model.robot.transmissions]
    for block in model.robot.ros2_control:
        parents += [(element, "plugin") for element in block.element.find_all("transmission")]
    for element, tag in parents:
        type_element = element.find(tag)
        if type_element is not None and type_element.text and "$" not in type_element.text:
            yield type_element
