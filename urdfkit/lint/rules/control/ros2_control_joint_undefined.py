"""C707 ros2-control-joint-undefined."""

from __future__ import annotations

from urdfkit.lint.edits import meant, new_value
from urdfkit.lint.hidden import doubted
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class Ros2ControlJointUndefined(RobotRule):
    """``<ros2_control>`` names a joint that is not there, or commands one that is fixed.

    ## What it does
    Compares the joints of ``<ros2_control>`` with those of the robot. Those with a ``<command_interface>`` have to
    move; that a fixed joint is commanded is a warning.

    ## Why is this bad?
    The controller manager stops: "Joint … not found in URDF". What commands a fixed joint moves nothing, and
    in Gazebo there is no such joint.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
      <ros2_control name="arm" type="system">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
        <joint name="ellbow">
          <command_interface name="position"/>
          <state_interface name="position"/>
        </joint>
      </ros2_control>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint>
      <ros2_control name="arm" type="system">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
        <joint name="elbow">
          <command_interface name="position"/>
          <state_interface name="position"/>
        </joint>
      </ros2_control>
    </robot>
    ```

    ## Fix safety
    Unsafe: the joint with the nearest name is taken.
    """

    code = "C707"
    name = "ros2-control-joint-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint that the block names and the robot lacks."""
        joints = model.robot.joint_by_name
        for block in model.robot.ros2_control:
            for element in block.element.find_all("joint"):
                name = element.get("name")
                if not name or "$" in name:
                    continue
                if name in joints:
                    command = element.find("command_interface")
                    if command is not None and joints[name].type == "fixed":
                        message = f"<ros2_control> `{block.name}` commands the joint `{name}`, which is fixed"
                        yield self.at(model, command, message, joint=name, severity="warning")
                    continue
                near, hint = meant(name, joints)
                found = self.at(
                    model,
                    element,
                    f"<ros2_control> `{block.name}` has the joint `{name}`, which the robot does not have{hint}",
                    attribute="name",
                    joint=name,
                    fix=new_value(model, element, "name", near, "unsafe", f"Write `{near}`") if near else None,
                )
                yield from doubted(model, name, near, found)
