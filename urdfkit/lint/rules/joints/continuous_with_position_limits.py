"""J415 continuous-with-position-limits."""

from math import pi

from urdfkit.lint.finding import Fix
from urdfkit.lint.fix_builders import without_attribute
from urdfkit.lint.rule import Findings, Model, RobotRule


class ContinuousWithPositionLimits(RobotRule):
    """A continuous joint has position limits.

    ## What it does
    Checks for the attributes ``lower`` and ``upper`` in ``continuous`` joints. A range of at least one full turn, or
    two zeros, is reported as a note.

    ## Why is this bad?
    The limits have no effect: a continuous joint turns without limits.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
    -  <joint name="elbow" type="continuous">
    +  <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
         <limit lower="-1" upper="1" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix removes the limits, but the joint may be meant to be ``revolute``.
    """

    code = "J415"
    name = "continuous-with-position-limits"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each continuous joint with position limits."""
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type != "continuous" or limit is None or (limit.lower is None and limit.upper is None):
                continue
            lower, upper = limit.lower or 0.0, limit.upper or 0.0
            removals = [without_attribute(model, limit.element, side, "unsafe", "") for side in ("lower", "upper")]
            edits = tuple(edit for removal in removals if removal is not None for edit in removal.edits)
            is_unbounded = lower == upper == 0.0 or upper - lower >= 2 * pi - 0.01
            yield self.at(
                model,
                limit.element,
                f"position limits have no effect on continuous joint `{joint.name}`",
                attribute="lower" if limit.lower is not None else "upper",
                joint=joint.name,
                help="remove lower and upper, or use the type `revolute` if the joint has end stops",
                fix=Fix("unsafe", "Remove the position limits", edits) if edits else None,
                severity="note" if is_unbounded else None,
            )
