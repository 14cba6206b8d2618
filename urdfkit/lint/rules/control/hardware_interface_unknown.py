"""C703 hardware-interface-unknown."""

from urdfkit.lint.facts.control.hardware_interfaces import INTERFACES, PACKAGE, written
from urdfkit.lint.fix_builders import nearest, new_text
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class HardwareInterfaceUnknown(RobotRule):
    """A transmission names an unknown hardware interface.

    ## What it does
    Checks for ``<hardwareInterface>`` values that nearly match an interface of the hardware_interface package.
    Interfaces of other packages are accepted.

    ## Why is this bad?
    Loading fails with "No suitable hardware interface", and controllers for the joint do not start.

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
    Safe: the name differs from a known interface by only one or two letters.
    """

    code = "C703"
    name = "hardware-interface-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each misspelt interface."""
        for text, element, _ in written(model.robot):
            package, slash, name = text.rpartition("/")
            if name in INTERFACES and package in ("", PACKAGE):
                continue
            match = name if name in INTERFACES else nearest(name, INTERFACES, cutoff=0.85)
            if match is None or (slash and package != PACKAGE and nearest(package, [PACKAGE], cutoff=0.7) is None):
                continue
            qualified = f"{PACKAGE}/{match}"
            yield self.at(
                model,
                element,
                f"unknown hardware interface `{text}`; did you mean `{qualified}`?",
                fix=new_text(model, element, qualified, "safe", f"Replace with `{qualified}`"),
            )
