"""C701 transmission-joint-undefined."""

from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class TransmissionJointUndefined(RobotRule):
    """A transmission names an undefined joint.

    ## What it does
    Compares the joints of ``<transmission>`` with the joints of the robot.

    ## Why is this bad?
    The transmission is skipped with a log message, and controllers for the joint do not start.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
      <transmission name="elbow_transmission">
        <type>transmission_interface/SimpleTransmission</type>
        <joint name="elbo">
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
    Unsafe: the fix writes the nearest joint name, which may not be the intended one.
    """

    code = "C701"
    name = "transmission-joint-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined joint of a transmission."""
        joints = model.robot.joint_by_name
        for transmission in model.robot.transmissions:
            for part in transmission.joints:
                if not part.name or part.name in joints or "$" in part.name:
                    continue
                near, hint = meant(part.name, joints)
                if near is None and model.is_incomplete:
                    continue  # The dropped part may define the joint.
                finding = self.at(
                    model,
                    part.element,
                    f"transmission `{transmission.name}` names the undefined joint `{part.name}`{hint}",
                    attribute="name",
                    joint=part.name,
                    fix=new_value(model, part.element, "name", near, "unsafe", f"Replace with `{near}`")
                    if near
                    else None,
                )
                yield from unless_masked(model, part.name, near, finding)
