"""J420 safety-controller-inconsistent."""

from urdfkit.lint.rule import Findings, Model, RobotRule

DISABLED_DISTANCE = 6.0
"""Distance from the hard limit [rad, m] from which a soft limit counts as deliberately disabled."""


class SafetyControllerInconsistent(RobotRule):
    """A ``<safety_controller>`` has inconsistent soft limits, or lacks ``k_velocity``.

    ## What it does
    Checks that each ``<safety_controller>`` has a ``k_velocity``, that its soft limits are within those of ``<limit>``,
    and that its lower soft limit is not greater than the upper one.

    ## Why is this bad?
    urdfdom rejects a joint without ``k_velocity``. A soft limit outside the hard limits never acts, so the joint
    reaches its end stop at full speed. If the lower soft limit is greater than the upper one, both limits act at the
    same time.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
         <limit lower="-1" upper="1" effort="10" velocity="2"/>
    -    <safety_controller soft_lower_limit="-1.5" soft_upper_limit="0.9" k_position="10" k_velocity="5"/>
    +    <safety_controller soft_lower_limit="-0.9" soft_upper_limit="0.9" k_position="10" k_velocity="5"/>
       </joint>
     </robot>
    ```
    """

    code = "J420"
    name = "safety-controller-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each inconsistent safety controller."""
        for joint in model.robot.joints:
            safety, limit = joint.safety_controller, joint.limit
            if safety is None:
                continue
            if "k_velocity" not in safety.element.attributes:
                message = f"<safety_controller> of joint `{joint.name}` lacks k_velocity"
                yield self.at(model, safety.element, message, joint=joint.name, help="add k_velocity")
            if (
                joint.type not in ("revolute", "prismatic")
                or limit is None
                or limit.lower is None
                or limit.upper is None
            ):
                continue
            unit = "rad" if joint.type == "revolute" else "m"
            lower, upper = safety.soft_lower_limit, safety.soft_upper_limit
            if lower > upper and {"soft_lower_limit", "soft_upper_limit"} <= set(safety.element.attributes):
                message = f"soft_lower_limit {lower:g} {unit} of joint `{joint.name}` is greater than "
                message += f"soft_upper_limit {upper:g} {unit}"
                help = "swap the soft limits or correct their signs"
                yield self.at(model, safety.element, message, attribute="soft_lower_limit", joint=joint.name, help=help)
                continue
            is_reported = False
            for attribute, soft, hard, is_outside in (
                (
                    "soft_lower_limit",
                    safety.soft_lower_limit,
                    limit.lower,
                    1e-9 < limit.lower - safety.soft_lower_limit < DISABLED_DISTANCE,
                ),
                (
                    "soft_upper_limit",
                    safety.soft_upper_limit,
                    limit.upper,
                    1e-9 < safety.soft_upper_limit - limit.upper < DISABLED_DISTANCE,
                ),
            ):
                if is_outside and attribute in safety.element.attributes and not is_reported:
                    is_reported = True  # the other limit usually has the same cause
                    message = (
                        f"{attribute} {soft:g} {unit} of joint `{joint.name}` is beyond the hard limit {hard:g} {unit}"
                    )
                    help = "write a soft limit inside the hard limits"
                    yield self.at(model, safety.element, message, attribute=attribute, joint=joint.name, help=help)
