"""C715 transmission-type-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_text
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_PACKAGE = "transmission_interface"
_TYPES = ("SimpleTransmission", "DifferentialTransmission", "FourBarLinkageTransmission")
"""The transmissions of transmission_interface, in ros_control and in ros2_control alike."""


class TransmissionTypeUnknown(RobotRule):
    """There is no such transmission.

    ## What it does
    Looks for ``<type>`` of a transmission, and ``<plugin>`` of one in ``<ros2_control>``, that is nearly one of those
    of transmission_interface. Transmissions of other packages pass.

    ## Why is this bad?
    pluginlib finds no such class: the robot's hardware does not load its transmissions.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
      <transmission name="elbow_transmission">
        <type>transmission_interface/SimpleTransmision</type>
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

    ## Fix safety
    Safe: it is one letter or two from the right name.
    """

    code = "C715"
    name = "transmission-type-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each transmission that is misspelt."""
        for element in _types(model):
            package, slash, name = element.text.rpartition("/")
            right = name if name in _TYPES else nearest(name, _TYPES, likeness=0.85)
            is_ours = not slash or package == _PACKAGE or nearest(package, [_PACKAGE], likeness=0.8) is not None
            whole = f"{_PACKAGE}/{right}"
            if right is None or not is_ours or element.text in (whole, right):
                continue
            yield self.at(
                model,
                element,
                f"there is no transmission `{element.text}`; did you mean `{whole}`?",
                fix=new_text(model, element, whole, "safe", f"Write `{whole}`"),
            )


def _types(model: Model) -> Iterator[Element]:
    """Yield the elements that name transmissions."""
    named = [(transmission.element, "type") for transmission in model.robot.transmissions]
    for block in model.robot.ros2_control:
        named += [(element, "plugin") for element in block.element.find_all("transmission")]
    for element, tag in named:
        found = element.find(tag)
        if found is not None and found.text and "$" not in found.text:
            yield found
