"""J401 joint-type-missing."""

from urdfkit.description.urdf.robot import JOINT_TYPES, Joint
from urdfkit.lint.fix_builders import more_attributes
from urdfkit.lint.rule import Findings, Model, RobotRule


class JointTypeMissing(RobotRule):
    """A joint has no ``type``.

    ## What it does
    Checks for joints without the attribute ``type``.

    ## Why is this bad?
    The attribute has no default: every parser rejects the robot.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base"/>
       <link name="wheel"/>
    -  <joint name="wheel_joint">
    +  <joint name="wheel_joint" type="continuous">
         <parent link="base"/>
         <child link="wheel"/>
         <axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix guesses the type from the other elements. A joint without ``<axis>`` becomes ``fixed``, a joint with
    position limits becomes ``revolute``, and any other joint becomes ``continuous``.
    """

    code = "J401"
    name = "joint-type-missing"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint without a type."""
        for joint in model.robot.joints:
            if joint.type is None:
                joint_type = _likely_type(joint)
                message = f"joint `{joint.name}` has no type"
                help = f'add type="{joint_type}", or another of the types {", ".join(JOINT_TYPES)}'
                fix = more_attributes(
                    model, joint.element, f'type="{joint_type}"', "unsafe", f'Add type="{joint_type}"'
                )
                yield self.at(model, joint.element, message, joint=joint.name, help=help, fix=fix)


def _likely_type(joint: Joint) -> str:
    if joint.element.find("axis") is None:
        return "fixed"
    has_limits = joint.limit is not None and (joint.limit.lower is not None or joint.limit.upper is not None)
    return "revolute" if has_limits else "continuous"
