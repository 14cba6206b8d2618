"""Z802 plugin-joint-undefined."""

from __future__ import annotations

from urdfkit.lint.hidden import doubted
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.plugins import Parameter
    from urdfkit.description.robot import Plugin
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_MAY_BE_FIXED = ("joint", "joints")
"""Meanings of parameters whose joints are only looked at, by force-torque sensors and state publishers."""


class PluginJointUndefined(RobotRule):
    """A Gazebo plugin names a joint that the robot does not have, or drives one that is fixed.

    ## What it does
    Looks up the joints in the parameters of the plugins we have a table of (diff drive, skid steer, joint state
    publisher, joint controllers), also the names they take when the parameter is left out. What drives turn must not be
    fixed, where it has an axis to turn about.

    ## Why is this bad?
    The plugin does nothing, or takes the simulator down with it.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="wheel_joint" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
      </joint>
      <gazebo>
        <plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">
          <jointName>wheel_hinge</jointName>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <link name="wheel"/>
      <joint name="wheel_joint" type="continuous">
        <parent link="base"/>
        <child link="wheel"/>
      </joint>
      <gazebo>
        <plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">
          <jointName>wheel_joint</jointName>
        </plugin>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the joint with the nearest name is taken.
    """

    code = "Z802"
    name = "plugin-joint-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint name that is no joint."""
        if not model.robot.gazebo:
            return
        from urdfkit.description.plugins import match

        for block in model.robot.gazebo:
            for plugin in (*block.plugins, *(plugin for sensor in block.sensors for plugin in sensor.plugins)):
                spec = match(plugin)
                if spec is not None:
                    for parameter in spec.parameters:
                        if parameter.names == "joint":
                            yield from self._check(model, plugin, parameter)

    def _check(self, model: Model, plugin: Plugin, parameter: Parameter) -> Iterator[Finding]:
        from urdfkit.description.plugins import values
        from urdfkit.errors import did_you_mean
        from urdfkit.lint.edits import meant, new_text

        joints = model.as_written.joint_by_name
        written = [(text, element) for text, element in values(plugin, parameter) if text]
        for text, element in written:
            if (
                text in joints
                and joints[text].type == "fixed"
                and joints[text].element.find("axis") is not None
                and parameter.meaning not in _MAY_BE_FIXED
            ):
                message = f"<{parameter.tag}> names `{text}`, which is fixed: Gazebo dissolves it"
                help = "give it the type of the joint that is meant: a wheel is continuous"
                yield self.at(model, element, message, joint=text, help=help)
            if text in joints or "::" in text or "$" in text or model.is_unresolved(element):
                continue
            message = f"<{parameter.tag}> names `{text}`, which is no joint"
            fix, near = None, None
            if text in model.robot.joint_by_name:
                help = f"{_lost(model, text)} would make it, but lacks its `xacro:` prefix"
            else:
                single = not parameter.separator or parameter.separator not in element.text
                near, hint = meant(text.strip("\"'"), joints)
                help = hint.removeprefix("; ") or f"joints: {', '.join(joints) or 'none'}"
                fix = new_text(model, element, near, "unsafe", f"Write `{near}`") if near and single else None
            found = self.at(model, element, message, joint=text, help=help, fix=fix)
            yield from doubted(model, text, near, found) if text not in model.robot.joint_by_name else (found,)
        default = parameter.default
        if not written and default is not None and default not in joints:
            found = self.at(
                model,
                plugin.element,
                f"<{parameter.tag}> is left out, and its default `{default}` is no joint",
                joint=default,
                help=f"add <{parameter.tag}>…</{parameter.tag}>{did_you_mean(default, joints)}",
            )
            yield from doubted(model, default, None, found)


def _lost(model: Model, joint: str) -> str:
    """Return the call, or definition, without prefix that the joint came from."""
    chain = model.robot.joint_by_name[joint].element.origin.expansions
    unprefixed = {item.position: item.name for item in model.expanded.unprefixed}
    for call in chain:
        if call.position in unprefixed:
            return f"`<{unprefixed[call.position]}>` ({model.shown(call.position)})"
    return "a macro"
