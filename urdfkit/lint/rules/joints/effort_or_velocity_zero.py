"""J409 effort-or-velocity-zero."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_MIN_OTHERS = 3
"""Number of joints with limits from which the only joint with a limit of zero is a warning."""


class EffortOrVelocityZero(RobotRule):
    """The effort or velocity limit of a joint is zero.

    ## What it does
    Checks for ``effort="0"`` and ``velocity="0"`` in the limits of movable joints. The finding is a warning with
    ``--target gz``, ``classic`` or ``isaac``, or if only one of four or more joints has such a limit. Otherwise it is a
    note, because models that are only displayed often omit real limits.

    ## Why is this bad?
    Simulators enforce the limits: with zero effort the joint cannot hold a load, and with zero velocity it never moves.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
    -    <limit lower="-1" upper="1" effort="0" velocity="2"/>
    +    <limit lower="-1" upper="1" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```
    """

    code = "J409"
    name = "effort-or-velocity-zero"
    severity = "note"
    not_for = frozenset(("moveit",))

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint with a limit of zero."""
        limits = [joint.limit for joint in model.robot.joints if joint.limit is not None and joint.mimic is None]
        counts = {name: sum(getattr(each, name) == 0.0 for each in limits) for name in ("effort", "velocity")}
        for joint in model.robot.joints:
            limit = joint.limit
            if limit is None or joint.type not in ("revolute", "prismatic", "continuous") or joint.mimic is not None:
                continue
            zero = [name for name in ("effort", "velocity") if getattr(limit, name) == 0.0]
            if zero:
                is_only = all(counts[name] == 1 for name in zero) and len(limits) > _MIN_OTHERS
                verb = "are" if len(zero) > 1 else "is"
                yield self.at(
                    model,
                    limit.element,
                    f"{' and '.join(zero)} limit{'s' if len(zero) > 1 else ''} of joint `{joint.name}` {verb} zero",
                    attribute=zero[0],
                    joint=joint.name,
                    help=f"write the {' and '.join(zero)} of the actuator",
                    severity="warning" if is_only or model.target in ("gz", "classic", "isaac") else None,
                    kind=" ".join(zero),
                )
