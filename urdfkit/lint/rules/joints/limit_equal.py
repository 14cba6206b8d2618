"""J406 limit-equal."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Limit
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class LimitEqual(RobotRule):
    """The lower limit of a joint equals the upper one.

    ## What it does
    Compares ``lower`` and ``upper`` of joints of type ``revolute`` and ``prismatic``; what is left out is 0. Other
    equal limits than 0 were written on purpose, and are a note.

    ## Why is this bad?
    The joint cannot move. Mostly the limits were forgotten; where a rigid joint is meant, ``fixed`` says so, and
    solvers are spared a constraint.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit effort="10" velocity="2"/>
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
        <limit lower="-1.5" upper="1.5" effort="10" velocity="2"/>
      </joint>
    </robot>
    ```
    """

    code = "J406"
    name = "limit-equal"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each joint that its limits freeze."""
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type not in ("revolute", "prismatic") or limit is None:
                continue
            if any(limit.element.get(side) is not None and value is None for side, value in _sides(limit)):
                continue
            lower, upper = limit.lower or 0.0, limit.upper or 0.0
            if lower == upper:
                unit = "rad" if joint.type == "revolute" else "m"
                left_out = limit.lower is None and limit.upper is None
                what = (
                    "lower and upper are left out, so both are 0" if left_out else f"both limits are {lower:g} {unit}"
                )
                endless = "a joint that turns without end is `continuous`; " if joint.type == "revolute" else ""
                yield self.at(
                    model,
                    limit.element,
                    f"joint `{joint.name}` cannot move: {what}",
                    joint=joint.name,
                    help=f"{endless}a joint that never moves is `fixed`",
                    severity="info" if lower else None,
                )


def _sides(limit: Limit) -> tuple[tuple[str, float | None], ...]:
    return ("lower", limit.lower), ("upper", limit.upper)
