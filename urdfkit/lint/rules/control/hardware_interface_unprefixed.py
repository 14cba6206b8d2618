"""C704 hardware-interface-unprefixed."""

from __future__ import annotations

from urdfkit.lint.edits import new_text
from urdfkit.lint.interfaces import INTERFACES, PACKAGE, written
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class HardwareInterfaceUnprefixed(RobotRule):
    """A hardware interface lacks its package.

    ## What it does
    Looks for ``EffortJointInterface`` and its like without ``hardware_interface/`` before them.

    ## Why is this bad?
    gazebo_ros_control calls it deprecated at each start.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
      <transmission name="elbow_transmission">
        <type>transmission_interface/SimpleTransmission</type>
        <joint name="elbow">
          <hardwareInterface>EffortJointInterface</hardwareInterface>
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
    Safe: both mean the same.
    """

    code = "C704"
    name = "hardware-interface-unprefixed"
    severity = "info"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each interface without its package."""
        for text, element, _ in written(model.robot):
            if text in INTERFACES:
                whole = f"{PACKAGE}/{text}"
                yield self.at(
                    model,
                    element,
                    f"`{text}` lacks its package: `{whole}`",
                    fix=new_text(model, element, whole, "safe", f"Write `{whole}`"),
                )
