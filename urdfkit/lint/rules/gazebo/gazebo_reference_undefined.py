"""Z801 gazebo-reference-undefined."""

from urdfkit.description.urdf.robot import GazeboBlock
from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.model.masked_names import is_typo, unless_masked
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_OF_JOINTS = ("force_torque", "forcetorque")
"""Types of sensors that belong to joints."""


class GazeboReferenceUndefined(RobotRule):
    """A ``<gazebo reference="…">`` block refers to an undefined link or joint, or holds a sensor without a link.

    ## What it does
    Compares the reference of each ``<gazebo>`` block with the links and joints of the robot. The finding is an error if
    the name is misspelt or if the block contains a sensor or a plugin. Otherwise the block is probably a leftover, and
    the finding is a warning. Sensors in a block without a reference are reported as errors. A ``force_torque`` sensor
    belongs in the block of a joint, and other sensors belong in the block of a link; a sensor in the wrong kind of
    block is reported as a warning.

    ## Why is this bad?
    Gazebo silently drops the block with its friction, colours and sensors.

    ## Example
    ```diff
     <robot name="arm">
       <link name="left_finger"/>
    -  <gazebo reference="leftfinger">
    +  <gazebo reference="left_finger">
         <mu1>0.8</mu1>
       </gazebo>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the nearest link or joint name, which may not be the intended one.
    """

    code = "Z801"
    name = "gazebo-reference-undefined"
    fix = "unsafe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each block with an undefined reference, and for each sensor without a link."""
        for block in model.robot.gazebo:
            is_outside = not block.reference or block.reference in model.robot.joint_by_name
            if is_outside and block.reference not in model.robot.link_by_name:
                yield from self._sensors(model, block)
            elif block.reference in model.robot.link_by_name and block.reference not in model.robot.joint_by_name:
                yield from self._forces(model, block)
        yield from self._references(model)

    def _sensors(self, model: Model, block: GazeboBlock) -> Findings:
        for sensor in block.sensors:
            if block.reference and (sensor.type or "").strip() in _OF_JOINTS:
                continue
            place = f"the block of joint `{block.reference}`" if block.reference else "a <gazebo> without reference"
            message = f"sensor `{sensor.name or 'sensor'}` is in {place}"
            help = "write it in the <gazebo reference=…> of a link"
            yield self.at(model, sensor.element, message, help=help, severity="warning" if block.reference else None)

    def _forces(self, model: Model, block: GazeboBlock) -> Findings:
        """Yield a finding for each sensor of forces in a joint that is in the block of a link."""
        above = [joint.name for joint in model.robot.joints if joint.child == block.reference]
        for sensor in block.sensors if above else ():
            if (sensor.type or "").strip() in _OF_JOINTS:
                message = f"sensor `{sensor.name or 'sensor'}` measures a joint, but `{block.reference}` is a link"
                help = f"write it in the <gazebo> of a joint, such as `{above[0]}`"
                yield self.at(model, block.element, message, attribute="reference", help=help, severity="warning")

    def _references(self, model: Model) -> Findings:
        robot = model.robot
        for block in robot.gazebo:
            name = block.reference
            if not name or name in robot.link_by_name or name in robot.joint_by_name or "$" in name:
                continue
            near, hint = meant(name, [*robot.link_by_name, *robot.joint_by_name])
            is_misspelt = near is not None and is_typo(name, near)
            is_leftover = not (is_misspelt or block.sensors or block.plugins)
            if is_leftover:
                near, hint = None, ""
            finding = self.at(
                model,
                block.element,
                f"`{name}` is neither a link nor a joint" + hint,
                attribute="reference",
                help=None if near else "correct the reference, or remove the block",
                fix=new_value(model, block.element, "reference", near, "unsafe"),
                severity="warning" if is_leftover else None,
                kind="reference",
                names=(name,),
            )
            yield from unless_masked(model, name, near, finding)
