"""C707 ros2-control-joint-undefined."""

from urdfkit.description.urdf.queries import UNDRIVEN
from urdfkit.lint.facts.gazebo.plugins import runs_ros2_control
from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class Ros2ControlJointUndefined(RobotRule):
    """``<ros2_control>`` names an undefined joint, or commands a fixed joint.

    ## What it does
    Compares the joints of ``<ros2_control>`` with the joints of the robot. A ``<command_interface>`` of a fixed joint
    is reported as a warning.

    ## Why is this bad?
    The controller manager stops with "Joint … not found in URDF". Commands to a fixed joint have no effect, and Gazebo
    removes fixed joints from the model.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
       <ros2_control name="arm" type="system">
         <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
    -    <joint name="ellbow">
    +    <joint name="elbow">
           <command_interface name="position"/>
           <state_interface name="position"/>
         </joint>
       </ros2_control>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest joint name, which may not be the intended one.
    """

    code = "C707"
    name = "ros2-control-joint-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined joint and each commanded fixed joint."""
        from urdfkit.lint.facts.root_cause import type_at

        joints = model.robot.joint_by_name
        for block in model.robot.ros2_control:
            for element in block.element.find_all("joint"):
                name = element.get("name")
                if not name or "$" in name:
                    continue
                if name in joints:
                    command = element.find("command_interface")
                    if command is not None and joints[name].type == "fixed":
                        message = f"<ros2_control> `{block.name}` commands the fixed joint `{name}`"
                        place, is_wrong = type_at(model, joints[name])
                        yield self.at(
                            model,
                            command,
                            message,
                            joint=name,
                            severity="warning",
                            kind="fixed",
                            other=place,
                            is_other_wrong=is_wrong,
                        )
                    elif joints[name].type in UNDRIVEN and runs_ros2_control(model.robot):
                        message = f"<ros2_control> `{block.name}` names the {joints[name].type} joint `{name}`"
                        yield self.at(model, element, message, attribute="name", joint=name, severity="note")
                    continue
                near, hint = meant(name, joints)
                message = f"<ros2_control> `{block.name}` names the undefined joint `{name}`" + hint
                fix = new_value(model, element, "name", near, "unsafe")
                finding = self.at(model, element, message, attribute="name", joint=name, fix=fix, kind="undefined")
                yield from unless_masked(model, name, near, finding)
