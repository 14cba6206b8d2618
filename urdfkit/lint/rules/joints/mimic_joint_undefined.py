"""J416 mimic-joint-undefined."""

from urdfkit.description.urdf.robot import Joint
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.twins import mirrored, side_of
from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.model.masked_names import unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule


class MimicJointUndefined(RobotRule):
    """A joint mimics an undefined or unsuitable joint, or itself.

    ## What it does
    Checks for ``<mimic joint="…"/>`` that names an undefined joint, a fixed, planar or floating joint, its own joint,
    or a joint that in turn mimics its own joint. Planar and floating joints cannot mimic others either. Also reports:

    - a joint that mimics a joint on the other side of the robot, although its own side has the corresponding joint
    - mimic plugins of Gazebo Classic that name undefined joints or swap the two joints

    ## Why is this bad?
    Parsers do not report the error. The joint never moves, or robot_state_publisher does not publish its frame.

    ## Example
    ```diff
     <robot name="hand">
       <link name="palm"/>
       <link name="left"/>
       <link name="right"/>
       <joint name="left_finger" type="prismatic">
         <parent link="palm"/>
         <child link="left"/>
         <axis xyz="0 1 0"/>
         <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
       </joint>
       <joint name="right_finger" type="prismatic">
         <parent link="palm"/>
         <child link="right"/>
         <axis xyz="0 -1 0"/>
         <limit lower="0" upper="0.04" effort="10" velocity="0.1"/>
    -    <mimic joint="leftfinger"/>
    +    <mimic joint="left_finger"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest joint name, which may not be the intended one.
    """

    code = "J416"
    name = "mimic-joint-undefined"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint without a valid joint to mimic."""
        for joint in model.robot.joints:
            mimic = joint.mimic
            if mimic is None:
                continue
            others = [name for name in model.robot.joint_by_name if name != joint.name]
            if mimic.joint in others:
                message, help = _unsuitable(model, joint, mimic.joint), "name a revolute, continuous or prismatic joint"
                if not message and (own := _on_own_side(joint, mimic.joint, model)):
                    message, help = (
                        f"joint `{joint.name}` mimics `{mimic.joint}`, which is on the other side",
                        f"name `{own}`",
                    )
                if message:
                    yield self.at(
                        model,
                        mimic.element,
                        message,
                        attribute="joint",
                        joint=joint.name,
                        help=f"{help}, or remove <mimic>",
                        severity="warning",
                    )
                continue
            if mimic.joint == joint.name:
                message = f"joint `{joint.name}` mimics itself"
                help = "name the joint to follow, or remove <mimic>"
                yield self.at(model, mimic.element, message, attribute="joint", joint=joint.name, help=help)
                continue
            suggestion, hint = meant(mimic.joint, others)
            finding = self.at(
                model,
                mimic.element,
                f"joint `{joint.name}` mimics the undefined joint `{mimic.joint}`" + hint,
                attribute="joint",
                joint=joint.name,
                fix=new_value(model, mimic.element, "joint", suggestion, "unsafe"),
                kind="undefined",
                names=(mimic.joint,),
            )
            yield from unless_masked(model, mimic.joint, suggestion, finding)
        for block in model.robot.gazebo:
            for plugin in block.plugins if model.target not in NOT_GAZEBO else ():
                if "mimic_joint" in (plugin.filename or ""):
                    yield from self._of_plugin(plugin.element, model)

    def _of_plugin(self, plugin: Element, model: Model) -> Findings:
        """Yield the defects of a mimic plugin of Gazebo Classic (README.md of roboticsgroup_gazebo_plugins)."""
        joints = model.robot.joint_by_name
        leader, follower = plugin.find("joint"), plugin.find("mimicJoint")
        for element in (leader, follower):
            if element is not None and element.text not in joints and "$" not in element.text:
                suggestion, hint = meant(element.text, list(joints))
                message = f"<{element.tag}> names the undefined joint `{element.text}`{hint}"
                yield from unless_masked(model, element.text, suggestion, self.at(model, element, message))
        led = joints.get(leader.text) if leader is not None else None
        if led is not None and led.mimic is not None and follower is not None and led.mimic.joint == follower.text:
            message = (
                f"`{led.name}` mimics `{follower.text}`, but the plugin makes `{follower.text}` follow `{led.name}`"
            )
            help = "swap the names in <joint> and <mimicJoint>"
            yield self.at(model, leader or plugin, message, joint=led.name, help=help, severity="warning")


def _on_own_side(joint: Joint, master: str, model: Model) -> str:
    """Return the counterpart on the side of a joint of the joint that it mimics; empty if it does not cross the sides.

    A counterpart that itself mimics is no other choice: grippers have one driven joint.
    """
    joints = model.robot.joint_by_name
    own = next((name for name in mirrored(master) if name in joints), joint.name)
    if own == joint.name or joints[own].mimic is not None or "" in (sides := {side_of(joint.name), side_of(master)}):
        return ""
    return own if len(sides) == 2 else ""


def _unsuitable(model: Model, joint: Joint, master: str) -> str:
    """Return why a joint cannot mimic another one; empty if it can."""
    joints = model.robot.joint_by_name
    for each in (joint, joints[master]):
        if each.type in ("planar", "floating"):
            return f"joint `{joint.name}` mimics joint `{master}`, but `{each.name}` is {each.type}"
    if joints[master].type == "fixed":
        return f"joint `{joint.name}` mimics the fixed joint `{master}`"
    passed = [joint.name]
    while master in joints and master not in passed:
        passed.append(master)
        mimic = joints[master].mimic
        if mimic is None:
            return ""
        master = mimic.joint
    if master != joint.name:
        return ""  # Another joint of the chain is reported.
    return f"mimic joints form a cycle: {' → '.join(f'`{name}`' for name in [*passed, master])}"
