"""Z802 plugin-joint-undefined."""

from urdfkit.defect_message import Suggestion
from urdfkit.description.plugins import Parameter, PluginSpec
from urdfkit.description.urdf.robot import Plugin
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Position
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_MAY_BE_FIXED = ("joint", "joints")
"""Meanings of parameters whose joints are only read, by force-torque sensors and state publishers."""


class PluginJointUndefined(RobotRule):
    """A Gazebo plugin names an undefined joint, or drives a fixed joint.

    ## What it does
    Checks the joint parameters of known plugins (differential drive, skid steer, joint state publisher, joint
    controllers), including the default names of missing parameters. A joint that a drive turns must not be fixed. A
    joint that one plugin names twice is reported as a warning.

    ## Why is this bad?
    The plugin does nothing, or crashes the simulator.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="wheel"/>
       <joint name="wheel_joint" type="continuous">
         <parent link="base"/>
         <child link="wheel"/>
       </joint>
       <gazebo>
         <plugin name="joints" filename="libgazebo_ros_joint_state_publisher.so">
    -      <jointName>wheel_hinge</jointName>
    +      <jointName>wheel_joint</jointName>
         </plugin>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest joint name, which may not be the intended one.
    """

    code = "Z802"
    name = "plugin-joint-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each undefined joint and each fixed joint that a plugin drives."""
        if not model.robot.gazebo:
            return
        from urdfkit.description.plugins import match

        for block in model.robot.gazebo:
            for plugin in (*block.plugins, *(plugin for sensor in block.sensors for plugin in sensor.plugins)):
                spec = match(plugin)
                if spec is not None:
                    fixed: set[Position] = set()
                    for parameter in spec.parameters:
                        if parameter.names == "joint":
                            yield from self._check(model, plugin, parameter, fixed)
                    yield from self._repeated(model, plugin, spec)

    def _repeated(self, model: Model, plugin: Plugin, spec: PluginSpec) -> Findings:
        """Yield a finding for each joint that a plugin names twice: in one parameter, or for both sides of steering."""
        from urdfkit.description.plugins import values

        joints = model.robot.joint_by_name
        seen: dict[tuple[str, str], Element] = {}
        for parameter in spec.parameters:
            kind = "steering" if "steering" in parameter.tag else parameter.meaning
            for text, element in values(plugin, parameter) if parameter.names == "joint" else ():
                if text not in joints or element is plugin.element:
                    continue
                is_repeated = (kind, text) in seen and (seen[kind, text] is not element or bool(parameter.separator))
                seen.setdefault((kind, text), element)
                if is_repeated:
                    message = f"<{parameter.tag}> names joint `{text}` a second time"
                    yield self.at(model, element, message, joint=text, help="name each joint once", severity="warning")

    def _check(self, model: Model, plugin: Plugin, parameter: Parameter, fixed: set[Position]) -> Findings:
        """Yield the findings for one parameter; of fixed joints that one macro defines, only the first."""
        from urdfkit.description.plugins import values
        from urdfkit.errors import did_you_mean, nearest
        from urdfkit.lint.fix_builders import new_text

        joints = model.as_written.joint_by_name
        named = [(text, element) for text, element in values(plugin, parameter) if text]
        for text, element in named:
            if (
                text in joints
                and joints[text].type == "fixed"
                and joints[text].element.find("axis") is not None
                and parameter.meaning not in _MAY_BE_FIXED
                and joints[text].element.origin.position not in fixed
            ):
                fixed.add(joints[text].element.origin.position)
                message = f"<{parameter.tag}> names the fixed joint `{text}`, which Gazebo removes"
                help = "set the type of the joint; a wheel is continuous"
                alike = [one.name for one in joints.values() if one.element.origin.position in fixed]
                yield self.at(model, element, message, joint=text, help=help, kind="fixed", names=tuple(alike))
            if text in joints or "::" in text or "$" in text or model.is_unresolved(element):
                continue
            message = f"<{parameter.tag}> names the undefined joint `{text}`"
            fix, near = None, None
            if text in model.robot.joint_by_name:
                help = f"add the prefix `xacro:` to {_unprefixed_call(model, text)}, which defines the joint"
            else:
                is_single = not parameter.separator or parameter.separator not in element.text
                near = nearest(text.strip("\"'"), joints, cutoff=0.7)
                help = Suggestion(near, before="") or f"joints of the robot: {', '.join(joints) or 'none'}"
                fix = new_text(model, element, near, "unsafe") if near and is_single else None
            finding = self.at(model, element, message, joint=text, help=help, fix=fix, kind="undefined")
            yield from (
                unless_masked(model, text, near, finding) if text not in model.robot.joint_by_name else (finding,)
            )
        default = parameter.default
        if not named and default is not None and default not in joints:
            finding = self.at(
                model,
                plugin.element,
                f"<{parameter.tag}> is missing, and its default `{default}` is not a joint",
                joint=default,
                help=f"add <{parameter.tag}>…</{parameter.tag}>" + did_you_mean(default, joints),
            )
            yield from unless_masked(model, default, None, finding)


def _unprefixed_call(model: Model, joint: str) -> str:
    """Return the macro call or definition without ``xacro:`` prefix that defines a joint."""
    chain = model.robot.joint_by_name[joint].element.origin.expansions
    unprefixed = {item.position: item.name for item in model.expanded.unprefixed}
    for call in chain:
        if call.position in unprefixed:
            return f"`<{unprefixed[call.position]}>` ({model.shown(call.position)})"
    return "the macro call"
