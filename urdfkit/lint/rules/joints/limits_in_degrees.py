"""J407 limits-in-degrees."""

from __future__ import annotations

from math import pi, radians

from urdfkit.lint.edits import new_value
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Limit
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class LimitsInDegrees(RobotRule):
    """Limits of a joint seem to be in degrees.

    ## What it does
    Looks at the limits of joints of type ``revolute`` for round numbers beyond two turns (4π) and up to 360.

    ## Why is this bad?
    Limits are in radians: 90 is more than fourteen turns. Nothing complains, the joint just never stops.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <link name="arm"/>
      <joint name="elbow" type="revolute">
        <parent link="base"/>
        <child link="arm"/>
        <axis xyz="0 1 0"/>
        <limit lower="-90" upper="90" effort="10" velocity="2"/>
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
        <limit lower="-1.570796" upper="1.570796" effort="10" velocity="2"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: both limits are taken for degrees, but a joint may turn that often.
    """

    code = "J407"
    name = "limits-in-degrees"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each pair of limits that look like degrees."""
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type != "revolute" or limit is None:
                continue
            suspects = [side for side in ("lower", "upper") if _is_degrees(getattr(limit, side))]
            if suspects:
                value = getattr(limit, suspects[-1])
                yield self.at(
                    model,
                    limit.element,
                    f"joint `{joint.name}`: {suspects[-1]}={value:g} rad is {abs(value) / (2 * pi):.1f} turns",
                    attribute=suspects[-1],
                    joint=joint.name,
                    help=f"limits are in rad: {value:g} degrees are {radians(value):.6g}",
                    fix=_in_radians(model, limit),
                )


def _is_degrees(value: float | None) -> bool:
    return value is not None and 4 * pi < abs(value) <= 360.0 and (2.0 * value).is_integer()


def _in_radians(model: Model, limit: Limit) -> Fix | None:
    edits: list[Edit] = []
    for side in ("lower", "upper"):
        value = getattr(limit, side)
        if value:
            one = new_value(model, limit.element, side, f"{radians(value):.7g}", "unsafe", "")
            if one is None:
                return None
            edits += one.edits
    return Fix("unsafe", "Convert degrees to radians", tuple(edits))
