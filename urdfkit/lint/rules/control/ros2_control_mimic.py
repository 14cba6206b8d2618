"""C720 ros2-control-mimic-contradiction."""

from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.root_cause import call_of
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class Ros2ControlMimic(RobotRule):
    """The ``mimic`` parameter of a joint in ``<ros2_control>`` contradicts the robot.

    ## What it does
    Compares the parameter with the joints of the robot and with the ``<mimic>`` of the same joint. From Jazzy on, also
    reports a mimic joint with a command interface. Without a target, the rule assumes the release that the files of the
    packages name.

    ## Why is this bad?
    The hardware and ``robot_state_publisher`` couple the joint to different joints, or the description is rejected.

    ## Example
    ```diff
     <robot name="hand">
       <link name="palm"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_finger" type="continuous">
         <parent link="palm"/><child link="left"/><axis xyz="0 0 1"/>
       </joint>
       <joint name="right_finger" type="continuous">
         <parent link="palm"/><child link="right"/><axis xyz="0 0 1"/><mimic joint="left_finger"/>
       </joint>
       <ros2_control name="hand" type="system">
         <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
         <joint name="left_finger"><command_interface name="position"/><state_interface name="position"/></joint>
    -    <joint name="right_finger"><param name="mimic">right_finger</param></joint>
    +    <joint name="right_finger"><param name="mimic">left_finger</param></joint>
       </ros2_control>
     </robot>
    ```
    """

    code = "C720"
    name = "ros2-control-mimic-contradiction"
    severity = "warning"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each parameter that names another joint than the robot."""
        joints = model.robot.joint_by_name
        for block in model.robot.ros2_control:
            for element in block.element.find_all("joint"):
                name = element.get("name") or ""
                if (message := _commanded(model, element, name)) is not None:
                    place = element.find("command_interface") or element
                    others = [
                        interface
                        for other in block.element.find_all("joint")
                        if _commanded(model, other, other.get("name") or "") is None
                        and (interface := other.find("command_interface")) is not None
                    ]
                    call = call_of(place, others)  # of a macro that is right for other joints
                    yield self.at(model, call or place, message, joint=name, help="remove its command interfaces")
                for parameter in (each for each in element.find_all("param") if each.get("name") == "mimic"):
                    master = parameter.text.strip()
                    if name not in joints or "$" in master:
                        continue
                    mimic = joints[name].mimic
                    message = ""
                    if master == name:
                        message = f"joint `{name}` of <ros2_control> mimics itself"
                    elif mimic is not None and mimic.joint != master and mimic.joint in joints:
                        other = mimic.joint
                        message = f"joint `{name}` mimics `{master}` in <ros2_control>, but `{other}` in its <mimic>"
                    elif master not in joints and not model.is_incomplete:
                        message = f"joint `{name}` of <ros2_control> mimics the undefined joint `{master}`"
                    if message:
                        help = f"write `{mimic.joint}`" if mimic is not None else None
                        yield self.at(model, parameter, message, joint=name, help=help)


def _commanded(model: Model, element: Element, name: str) -> str | None:
    """Return the message for a mimic joint with command interfaces, which ros2_control refuses since Jazzy.

    Source: ros2_control (hardware_interface/src/component_parser.cpp).
    """
    from urdfkit.lint.facts.gazebo.named_releases import is_since_jazzy

    joint = model.robot.joint_by_name.get(name)
    is_mimic = joint is not None and joint.mimic is not None and (element.get("mimic") or "true").lower() != "false"
    if not is_mimic or element.find("command_interface") is None or not is_since_jazzy(model):
        return None
    return f"joint `{name}` mimics another joint and has a command interface, which ros2_control rejects"
