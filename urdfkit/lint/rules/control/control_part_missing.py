"""C717 control-part-missing."""

from urdfkit.description.xml.element import Element
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.control.hardware_interfaces import is_old, misspelt_parts
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_REDUCTIONS = ("mechanicalReduction", "mechanical_reduction")


class ControlPartMissing(RobotRule):
    """A transmission or ``<ros2_control>`` block lacks a required element, or has a reduction ratio of zero.

    ## What it does
    Checks for transmissions without ``<type>`` or ``<joint>``, and for ``<ros2_control>`` blocks whose ``<hardware>``
    has no ``<plugin>``. Also checks for a ``<mechanicalReduction>`` (ros_control) or ``<mechanical_reduction>``
    (ros2_control) of zero.

    ## Why is this bad?
    transmission_interface skips an incomplete transmission, and the resource manager of ros2_control rejects the
    description, so controllers do not find the joints. With a ratio of zero, both libraries throw "reduction ratio
    cannot be zero".

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
       <transmission name="elbow_transmission">
    +    <type>transmission_interface/SimpleTransmission</type>
         <joint name="elbow">
           <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
         </joint>
         <actuator name="elbow_motor"/>
       </transmission>
     </robot>
    ```

    ## References
    transmission_parser.cpp of ros_control (Noetic), component_parser.cpp of ros2_control (Rolling);
    simple_transmission.h of both.
    """

    code = "C717"
    name = "control-part-missing"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each missing element, one per block, and for each reduction ratio of zero."""
        if model.is_incomplete:
            return
        if not model.robot.ros2_control and model.target not in ("gz", "ros2"):
            for transmission in model.robot.transmissions:
                if not is_old(transmission) and transmission.element.children:
                    yield from self._missing_child(model, transmission.element, "type", "joint")
                    yield from self._zero_reductions(model, transmission.element)
        for block in model.robot.ros2_control:
            element = block.element
            hardware = element.find("hardware")
            if hardware is None:
                yield from self._missing_child(model, element, "hardware")
            elif not any(":" in child.tag for child in hardware.children):
                yield from self._missing_child(model, hardware, "plugin")
            for transmission_element in element.find_all("transmission"):
                yield from self._zero_reductions(model, transmission_element)

    def _zero_reductions(self, model: Model, element: Element) -> Findings:
        for part in element.walk():
            if part.tag in _REDUCTIONS and number(part.text) == 0.0:
                message = f"<{part.tag}> is zero, so the transmission is rejected"
                yield self.at(model, part, message, help="write 1 if the joint has no gear")

    def _missing_child(self, model: Model, element: Element, *tags: str) -> Findings:
        where = "ros2_control/hardware" if element.tag == "hardware" else element.tag
        if any(True for _ in misspelt_parts(element, where)):
            return
        for tag in tags:
            if element.find(tag) is None:
                name = element.get("name")
                label = f"<{element.tag}>{f' `{name}`' if name else ''}"
                yield self.at(model, element, f"missing <{tag}> in {label}", help=f"add <{tag}>")
                return
