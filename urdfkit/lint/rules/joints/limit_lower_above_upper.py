"""J405 limit-lower-gt-upper."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Limit
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class LimitLowerAboveUpper(RobotRule):
    """The lower limit of a joint is above its upper limit.

    ## What it does
    Compares ``lower`` and ``upper`` of joints of type ``revolute`` and ``prismatic``; what is left out is 0.

    ## Why is this bad?
    No position is allowed. check_urdf, Pinocchio and MuJoCo accept it all the same, and the joint jumps or sticks.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <limit lower="1.5" upper="-1.5" effort="10" velocity="2"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: the limits are swapped where both are written out as numbers, but a wrong sign is as likely.
    """

    code = "J405"
    name = "limit-lower-gt-upper"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each inverted limit."""
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type not in ("revolute", "prismatic") or limit is None:
                continue
            if any(model.is_unresolved(limit.element, side) for side in ("lower", "upper")):
                continue
            lower, upper = limit.lower or 0.0, limit.upper or 0.0
            if lower > upper:
                unit = "rad" if joint.type == "revolute" else "m"
                yield self.at(
                    model,
                    limit.element,
                    f"joint `{joint.name}`: the lower limit {lower:g} {unit} is above the upper limit {upper:g} {unit}",
                    attribute="lower" if limit.lower is not None else "upper",
                    joint=joint.name,
                    fix=_swapped(limit, model),
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
