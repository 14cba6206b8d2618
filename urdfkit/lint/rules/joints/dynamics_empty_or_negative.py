"""J419 dynamics-empty-or-negative."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class DynamicsEmptyOrNegative(RobotRule):
    """``<dynamics>`` says nothing, or has a negative value.

    ## What it does
    Looks for ``<dynamics>`` without ``damping`` and ``friction``, and for negative ones.

    ## Why is this bad?
    urdfdom refuses an empty one ("specified with no damping and no friction"), and a joint that gains energy as it
    moves makes every simulation explode.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="continuous">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <dynamics damping="-0.1"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="continuous">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <dynamics damping="0.1"/>
      </joint>
    </robot>
    ```
    """

    code = "J419"
    name = "dynamics-empty-or-negative"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each ``<dynamics>`` that is empty or negative."""
        for joint in model.robot.joints:
            dynamics = joint.dynamics
            if dynamics is None:
                continue
            written = dynamics.element.attributes
            if "damping" not in written and "friction" not in written:
                message = f"joint `{joint.name}`: <dynamics> has neither damping nor friction"
                yield self.at(model, dynamics.element, message, joint=joint.name)
            for name in ("damping", "friction"):
                value = getattr(dynamics, name)
                if value < 0.0:
                    yield self.at(
                        model,
                        dynamics.element,
                        f"joint `{joint.name}`: {name} {value:g} is negative: the joint gains energy as it moves",
                        attribute=name,
                        joint=joint.name,
                    )
