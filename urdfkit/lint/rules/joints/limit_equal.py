"""J406 limit-equal."""

import re

from urdfkit.description.urdf.robot import Limit
from urdfkit.description.urdf.version import RATE_LIMITS, version_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_TURNING = re.compile(r"(?i)wheel|roller|caster|rotor|propeller|spin|fan(?![a-z])|(?<![a-z])roll(?![a-z])")
"""Matches the name of a joint that turns without limits, so that its type is wrong and not its limit."""


class LimitEqual(RobotRule):
    """The lower and upper limits of a joint are equal.

    ## What it does
    Compares ``lower`` and ``upper`` of ``revolute`` and ``prismatic`` joints. Both default to 0 before URDF 1.2, which
    requires them. Equal limits other than 0 are reported as a note, because they are probably intended.

    ## Why is this bad?
    The joint cannot move. Usually the limits were not set. If the joint is meant to be rigid, the type ``fixed`` states
    this intent, and solvers need no constraint for it.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
    -    <limit effort="10" velocity="2"/>
    +    <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```
    """

    code = "J406"
    name = "limit-equal"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint whose limits prevent motion."""
        is_required = version_of(model.robot.element) >= RATE_LIMITS
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type not in ("revolute", "prismatic") or limit is None:
                continue
            if any(limit.element.get(side) is not None and value is None for side, value in _sides(limit)):
                continue
            if is_required and None in (limit.lower, limit.upper):
                continue  # Reported by E014.
            lower, upper = limit.lower or 0.0, limit.upper or 0.0
            if lower == upper:
                unit = "rad" if joint.type == "revolute" else "m"
                is_omitted = limit.lower is None and limit.upper is None
                reason = (
                    "<limit> has neither lower nor upper, and both default to 0"
                    if is_omitted
                    else f"both limits are {lower:g} {unit}"
                )
                alternative = "`continuous` if it turns without limits, or " if joint.type == "revolute" else ""
                is_turning = is_omitted and joint.type == "revolute" and _TURNING.search(joint.name) is not None
                yield self.at(
                    model,
                    joint.element if is_turning else limit.element,
                    f"joint `{joint.name}` cannot move: {reason}",
                    attribute="type" if is_turning else None,
                    joint=joint.name,
                    help=f"write the range of motion, or use the type {alternative}`fixed` if it never moves",
                    severity="note" if lower else None,
                    kind="omitted" if is_omitted else unit,
                )


def _sides(limit: Limit) -> tuple[tuple[str, float | None], ...]:
    return ("lower", limit.lower), ("upper", limit.upper)
