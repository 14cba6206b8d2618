"""C703 hardware-interface-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import nearest, new_text
from urdfkit.lint.interfaces import INTERFACES, PACKAGE, written
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class HardwareInterfaceUnknown(RobotRule):
    """There is no such hardware interface.

    ## What it does
    Looks for ``<hardwareInterface>`` that is nearly one of those that hardware_interface has. Interfaces of other
    packages pass.

    ## Why is this bad?
    "No suitable hardware interface": controllers for the joint do not start.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
      <transmission name="elbow_transmission">
        <type>transmission_interface/SimpleTransmission</type>
        <joint name="elbow">
          <hardwareInterface>hardware_interface/EffortJoinInterface</hardwareInterface>
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

    code = "C703"
    name = "hardware-interface-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each interface that is misspelt."""
        for text, element, _ in written(model.robot):
            package, slash, name = text.rpartition("/")
            if name in INTERFACES and package in ("", PACKAGE):
                continue
            right = name if name in INTERFACES else nearest(name, INTERFACES, likeness=0.85)
            if right is None or (slash and package != PACKAGE and nearest(package, [PACKAGE], likeness=0.7) is None):
                continue
            whole = f"{PACKAGE}/{right}"
            yield self.at(
                model,
                element,
                f"there is no hardware interface `{text}`; did you mean `{whole}`?",
                fix=new_text(model, element, whole, "safe", f"Write `{whole}`"),
            )
