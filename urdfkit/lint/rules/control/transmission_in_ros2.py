"""C705 transmission-in-ros2."""

from urdfkit.lint.rule import Findings, Model, RobotRule


class TransmissionInRos2(RobotRule):
    """ROS 2 does not read ``<transmission>`` elements of the robot.

    ## What it does
    With ``--target ros2`` or ``--target gz``, checks for ``<transmission>`` in robots without ``<ros2_control>``.

    ## Why is this bad?
    ROS 2 reads joint interfaces only from ``<ros2_control>``, so controllers find no joints.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
    -  <transmission name="elbow_transmission">
    -    <type>transmission_interface/SimpleTransmission</type>
    +  <ros2_control name="arm" type="system">
    +    <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
         <joint name="elbow">
    -      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
    +      <command_interface name="effort"/>
    +      <state_interface name="position"/>
         </joint>
    -    <actuator name="elbow_motor"/>
    -  </transmission>
    +  </ros2_control>
     </robot>
    ```
    """

    code = "C705"
    name = "transmission-in-ros2"
    severity = "warning"
    only_for = ("ros2", "gz")

    def check(self, model: Model) -> Findings:
        """Yield a finding at the first transmission of a robot without ``<ros2_control>``."""
        robot = model.robot
        if robot.transmissions and not robot.ros2_control and not model.is_incomplete:
            first = robot.transmissions[0]
            count = len(robot.transmissions)
            others = f" and {count - 1} more" if count > 1 else ""
            message = f"ROS 2 does not read transmissions (`{first.name}`{others})"
            yield self.at(model, first.element, message, attribute="name", help="declare the joints in <ros2_control>")
