"""C717 control-part-missing."""

from __future__ import annotations

from urdfkit.description.numbers import number
from urdfkit.lint.interfaces import is_old, misspelt_parts
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_REDUCTIONS = ("mechanicalReduction", "mechanical_reduction")


class ControlPartMissing(RobotRule):
    """A transmission, or a block of ros2_control, lacks what its reader asks for, or has a reduction of zero.

    ## What it does
    Looks for transmissions without ``<type>`` or without a ``<joint>``, and for ``<ros2_control>`` without the
    ``<plugin>`` of its ``<hardware>``. Also for a ``<mechanicalReduction>``, or ``<mechanical_reduction>`` of
    ros2_control, that is zero.

    ## Why is this bad?
    transmission_interface passes the whole transmission over, and the resource manager of ros2_control refuses the
    description: no controller finds its joints. Both throw "reduction ratio cannot be zero".

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
      <transmission name="elbow_transmission">
        <joint name="elbow">
          <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
        </joint>
        <actuator name="elbow_motor"/>
      </transmission>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
      <transmission name="elbow_transmission">
        <type>transmission_interface/SimpleTransmission</type>
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

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each block, and the first thing that it lacks."""
        if model.is_incomplete:
            return
        if not model.robot.ros2_control and model.target not in ("gz", "ros2"):
            for transmission in model.robot.transmissions:
                if not is_old(transmission) and transmission.element.children:
                    yield from self._lacks(model, transmission.element, "type", "joint")
                    yield from self._zero(model, transmission.element)
        for block in model.robot.ros2_control:
            element = block.element
            hardware = element.find("hardware")
            if hardware is None:
                yield from self._lacks(model, element, "hardware")
            elif not any(":" in child.tag for child in hardware.children):
                yield from self._lacks(model, hardware, "plugin")
            for inner in element.find_all("transmission"):
                yield from self._zero(model, inner)

    def _zero(self, model: Model, element: Element) -> Iterator[Finding]:
        for part in element.walk():
            if part.tag in _REDUCTIONS and number(part.text) == 0.0:
                yield self.at(
                    model,
                    part,
                    f"<{part.tag}> is zero: the transmission is refused",
                    help="write 1 where there is no gear",
                )

    def _lacks(self, model: Model, element: Element, *tags: str) -> Iterator[Finding]:
        where = "ros2_control/hardware" if element.tag == "hardware" else element.tag
        if any(True for _ in misspelt_parts(element, where)):
            return
        for tag in tags:
            if element.find(tag) is None:
                name = element.get("name")
                called = f"<{element.tag}>{f' `{name}`' if name else ''}"
                yield self.at(model, element, f"{called} lacks its <{tag}>")
                return
