"""J420 safety-controller-inconsistent."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

FAR = 6.0
"""Soft limits that lie farther out [rad, m] are meant to be none."""


class SafetyControllerInconsistent(RobotRule):
    """Soft limits lie outside the hard ones or exclude each other, or the safety controller lacks its gain.

    ## What it does
    Checks ``<safety_controller>``: ``k_velocity`` is required, the soft limits lie inside those of ``<limit>``, and the
    lower one below the upper one.

    ## Why is this bad?
    urdfdom refuses the joint without ``k_velocity``. Soft limits outside the hard ones never act: the joint runs
    into its end at full speed. Where the lower one is above the upper one, both hold it at once.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="10" velocity="2"/>
        <safety_controller soft_lower_limit="-1.5" soft_upper_limit="0.9" k_position="10" k_velocity="5"/>
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
        <axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="10" velocity="2"/>
        <safety_controller soft_lower_limit="-0.9" soft_upper_limit="0.9" k_position="10" k_velocity="5"/>
      </joint>
    </robot>
    ```
    """

    code = "J420"
    name = "safety-controller-inconsistent"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each safety controller that cannot do its work."""
        for joint in model.robot.joints:
            safety, limit = joint.safety_controller, joint.limit
            if safety is None:
                continue
            if "k_velocity" not in safety.element.attributes:
                message = f"joint `{joint.name}`: <safety_controller> lacks k_velocity"
                yield self.at(model, safety.element, message, joint=joint.name)
            if (
                joint.type not in ("revolute", "prismatic")
                or limit is None
                or limit.lower is None
                or limit.upper is None
            ):
                continue
            lower, upper = safety.soft_lower_limit, safety.soft_upper_limit
            if lower > upper and {"soft_lower_limit", "soft_upper_limit"} <= set(safety.element.attributes):
                yield self.at(
                    model,
                    safety.element,
                    f"joint `{joint.name}`: soft_lower_limit {lower:g} is above soft_upper_limit {upper:g}",
                    attribute="soft_lower_limit",
                    joint=joint.name,
                )
                continue
            for attribute, soft, hard, outside in (
                (
                    "soft_lower_limit",
                    safety.soft_lower_limit,
                    limit.lower,
                    1e-9 < limit.lower - safety.soft_lower_limit < FAR,
                ),
                (
                    "soft_upper_limit",
                    safety.soft_upper_limit,
                    limit.upper,
                    1e-9 < safety.soft_upper_limit - limit.upper < FAR,
                ),
            ):
                if outside and attribute in safety.element.attributes:
                    yield self.at(
                        model,
                        safety.element,
                        f"joint `{joint.name}`: {attribute} {soft:g} is outside of the limit {hard:g}",
                        attribute=attribute,
                        joint=joint.name,
                    )
