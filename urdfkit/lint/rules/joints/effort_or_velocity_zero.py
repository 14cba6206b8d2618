"""J409 effort-or-velocity-zero."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class EffortOrVelocityZero(RobotRule):
    """A joint may use no force, or have no speed.

    ## What it does
    Looks for ``effort="0"`` and ``velocity="0"`` on joints that move. With ``--target gz``, ``classic`` or
    ``isaac`` it is a warning, otherwise a note: models that are only looked at may have both.

    ## Why is this bad?
    Simulators take the limits at their word: the motor is too weak to hold the arm, or never turns.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="0" velocity="2"/>
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
      </joint>
    </robot>
    ```
    """

    code = "J409"
    name = "effort-or-velocity-zero"
    severity = "info"
    not_for = frozenset(("moveit",))

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each limit with a zero."""
        for joint in model.robot.joints:
            limit = joint.limit
            if limit is None or joint.type not in ("revolute", "prismatic", "continuous") or joint.mimic is not None:
                continue
            zero = [name for name in ("effort", "velocity") if getattr(limit, name) == 0.0]
            if zero:
                yield self.at(
                    model,
                    limit.element,
                    f"joint `{joint.name}`: {' and '.join(zero)} limit{'s are' if len(zero) > 1 else ' is'} zero",
                    attribute=zero[0],
                    joint=joint.name,
                    help="a motor that may use no force holds nothing" if "effort" in zero else None,
                    severity="warning" if model.target in ("gz", "classic", "isaac") else None,
                )
