"""J405 limit-lower-gt-upper."""

from urdfkit.description.urdf.robot import Limit
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import Findings, Model, RobotRule


class LimitLowerAboveUpper(RobotRule):
    """The lower limit of a joint is greater than its upper limit.

    ## What it does
    Compares ``lower`` and ``upper`` of ``revolute`` and ``prismatic`` joints. Both default to 0.

    ## Why is this bad?
    No position satisfies both limits. check_urdf, Pinocchio and MuJoCo accept the robot, but the joint jumps or jams.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
    -    <limit lower="1.5" upper="-1.5" effort="10" velocity="2"/>
    +    <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix swaps the limits if both are numbers, but a wrong sign is equally likely.
    """

    code = "J405"
    name = "limit-lower-gt-upper"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with inverted limits."""
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type not in ("revolute", "prismatic") or limit is None:
                continue
            if any(model.is_unresolved(limit.element, side) for side in ("lower", "upper")):
                continue
            lower, upper = limit.lower or 0.0, limit.upper or 0.0
            if lower > upper:
                unit = "rad" if joint.type == "revolute" else "m"
                message = f"lower limit {lower:g} {unit} of joint `{joint.name}` is greater than "
                message += f"its upper limit {upper:g} {unit}"
                attribute = "lower" if limit.lower is not None else "upper"
                help = "swap the limits or correct their signs"
                fix = _swapped(limit, model)
                # With zero as the upper limit, the two are swapped, and no value of a property is wrong.
                kind = "" if fix else "swapped" if upper == 0.0 else "computed"
                yield self.at(
                    model, limit.element, message, attribute=attribute, joint=joint.name, help=help, fix=fix, kind=kind
                )


def _swapped(limit: Limit, model: Model) -> Fix | None:
    lower, upper = model.literal(limit.element, "lower"), model.literal(limit.element, "upper")
    if lower is None or upper is None:
        return None
    span = model.document(limit.element.origin.position.file).source.span
    edits = (
        Edit(span(lower.value_start, lower.value_end), upper.value),
        Edit(span(upper.value_start, upper.value_end), lower.value),
    )
    return Fix("unsafe", "Swap the limits", edits)
