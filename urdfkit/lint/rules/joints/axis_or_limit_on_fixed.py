"""J418 axis-or-limit-on-fixed."""

from urdfkit.lint.finding import Fix
from urdfkit.lint.fix_builders import without_element
from urdfkit.lint.rule import Findings, Model, RobotRule


class AxisOrLimitOnFixed(RobotRule):
    """A fixed joint has an ``<axis>`` or a ``<limit>``.

    ## What it does
    Checks for ``<limit>`` and nonzero ``<axis>`` elements in ``fixed`` joints. A zero axis is accepted, because some
    exporters write it.

    ## Why is this bad?
    The elements have no effect, and may indicate that the joint type is wrong.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="tool"/>
       <joint name="mount" type="fixed">
         <parent link="base"/>
         <child link="tool"/>
    -    <axis xyz="0 0 1"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Safe: the fix removes an element that has no effect.
    """

    code = "J418"
    name = "axis-or-limit-on-fixed"
    severity = "note"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each axis or limit of a fixed joint."""
        for joint in model.robot.joints:
            if joint.type != "fixed":
                continue
            idle = [
                child
                for child in joint.element.children
                if child.tag == "limit" or (child.tag == "axis" and any(joint.axis))
            ]
            if idle:
                names = " and ".join(f"<{child.tag}>" for child in idle)
                fixes = [without_element(model, child, "safe", f"Remove {names}") for child in idle]
                edits = tuple(edit for fix in fixes if fix is not None for edit in fix.edits)
                yield self.at(
                    model,
                    idle[0],
                    f"{names} {'has' if len(idle) == 1 else 'have'} no effect on fixed joint `{joint.name}`",
                    joint=joint.name,
                    help=f"remove {names}, or change the joint type if the joint should move",
                    fix=Fix("safe", f"Remove {names}", edits) if None not in fixes else None,
                    kind="both" if len(idle) > 1 else "one",
                )
