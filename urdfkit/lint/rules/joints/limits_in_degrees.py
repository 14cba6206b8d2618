"""J407 limits-in-degrees."""

import re
from math import degrees, pi, radians

from urdfkit.description.urdf.robot import Limit
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

_ROUND = 0.01
"""Tolerance of multiples of half a degree [half degrees]."""


class LimitsInDegrees(RobotRule):
    """The limits of a joint appear to be in degrees.

    ## What it does
    Checks the limits of ``revolute`` joints for multiples of 0.5 that are greater than two turns (4π) and at most 360.
    Also reports limits that an expression such as ``radians(1.57)`` converts although they are already in radians. The
    rule assumes this if both converted limits are below 6.3° and the larger one is not a multiple of half a degree.

    ## Why is this bad?
    Limits are in radians: a limit of 90 rad allows more than fourteen turns. No tool reports an error, and the joint
    never reaches its limit.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
       <link name="arm"/>
       <joint name="elbow" type="revolute">
         <parent link="base"/>
         <child link="arm"/>
    -    <limit lower="-90" upper="90" effort="10" velocity="2"/>
    +    <limit lower="-1.570796" upper="1.570796" effort="10" velocity="2"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix converts both limits from degrees, but the joint may actually turn that far. No fix is offered if
    the other limit is not a multiple of 0.5.
    """

    code = "J407"
    name = "limits-in-degrees"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each joint whose limits appear to be in degrees."""
        for joint in model.robot.joints:
            limit = joint.limit
            if joint.type != "revolute" or limit is None:
                continue
            suspects = [side for side in ("lower", "upper") if _looks_like_degrees(getattr(limit, side))]
            if suspects:
                side = suspects[-1]
                value = getattr(limit, side)
                are_degrees = all((2.0 * (bound or 0.0)).is_integer() for bound in (limit.lower, limit.upper))
                converted = f": {value:g}° = {radians(value):.6g} rad" if are_degrees else ""
                message = f"{side} limit {value:g} rad of joint `{joint.name}` is {abs(value) / (2 * pi):.1f} turns"
                help = "write limits in radians" + converted
                fix = _in_radians(model, limit) if converted else None
                yield self.at(model, limit.element, message, attribute=side, joint=joint.name, help=help, fix=fix)
            elif (tiny := _converted_twice(model, limit)) is not None:
                value = getattr(limit, tiny)
                message = f"{tiny} limit {value:.3g} rad of joint `{joint.name}` is only {degrees(value):.3g}°"
                help = "write the value in degrees, or remove the conversion"
                yield self.at(model, limit.element, message, attribute=tiny, joint=joint.name, help=help)


def _looks_like_degrees(value: float | None) -> bool:
    return value is not None and 4 * pi < abs(value) <= 360.0 and (2.0 * value).is_integer()


def _converted_twice(model: Model, limit: Limit) -> str | None:
    """Return the side of the larger limit if both limits are radians that an expression converts from degrees."""
    sides = sorted(("lower", "upper"), key=lambda side: abs(getattr(limit, side) or 0.0))
    largest = getattr(limit, sides[-1])
    if not largest or abs(largest) > radians(2 * pi):
        return None
    tag = model.tag(limit.element.origin.position)
    written = tag.attributes.get(sides[-1]) if tag is not None else None
    is_converted = written is not None and re.search(r"radians\(|/\s*180", written.value) is not None
    is_round = abs(2.0 * degrees(largest) - round(2.0 * degrees(largest))) < _ROUND
    return sides[-1] if is_converted and not is_round else None


def _in_radians(model: Model, limit: Limit) -> Fix | None:
    edits: list[Edit] = []
    for side in ("lower", "upper"):
        value = getattr(limit, side)
        if value:
            fix = new_value(model, limit.element, side, f"{radians(value):.7g}", "unsafe", "")
            if fix is None:
                return None
            edits += fix.edits
    return Fix("unsafe", "Convert the limits to radians", tuple(edits))
