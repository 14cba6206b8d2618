"""C701 transmission-joint-undefined."""

from urdfkit.description.urdf.queries import UNDRIVEN
from urdfkit.lint.facts.control.hardware_interfaces import has_gazebo_ros_control
from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class TransmissionJointUndefined(RobotRule):
    """A transmission names an undefined joint, or a joint that it cannot drive.

    ## What it does
    Compares the joints of ``<transmission>`` with the joints of the robot. If the robot uses gazebo_ros_control, a
    joint without exactly one degree of freedom, such as a fixed joint, is reported as a warning. Transmissions with
    several joints are not checked for this, because a kinematic chain may end at a fixed joint.

    ## Why is this bad?
    The transmission is skipped with a log message, and controllers for the joint do not start. A simulation with
    urdfkit ignores the transmission.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="fixed"><parent link="base"/><child link="arm"/></joint>
       <transmission name="elbow_transmission">
         <type>transmission_interface/SimpleTransmission</type>
    -    <joint name="elbo">
    +    <joint name="elbow">
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
        """Yield a finding for each joint of a transmission that is undefined or cannot be driven."""
        joints = model.robot.joint_by_name
        for transmission in model.robot.transmissions:
            for part in transmission.joints:
                if not part.name or "$" in part.name:
                    continue
                if part.name in joints:
                    kind = joints[part.name].type
                    if kind in UNDRIVEN and len(transmission.joints) == 1 and has_gazebo_ros_control(model.robot):
                        yield self.at(
                            model,
                            part.element,
                            f"transmission `{transmission.name or ''}` names the {kind} joint `{part.name or ''}`",
                            attribute="name",
                            joint=part.name,
                            help="remove the transmission, or correct the type of the joint",
                            severity="warning",
                        )
                    continue
                near, hint = meant(part.name, joints)
                if near is None and model.is_incomplete:
                    continue  # The dropped part may define the joint.
                finding = self.at(
                    model,
                    part.element,
                    f"transmission `{transmission.name or ''}` names the undefined joint `{part.name or ''}`" + hint,
                    attribute="name",
                    joint=part.name,
                    names=(near,) if near else (),
                    kind="undefined",
                    fix=new_value(model, part.element, "name", near, "unsafe"),
                )
                yield from unless_masked(model, part.name, near, finding)
