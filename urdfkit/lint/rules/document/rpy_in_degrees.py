"""J408 rpy-in-degrees."""

from math import degrees, pi, radians

from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class RpyInDegrees(RobotRule):
    """The angles of an ``<origin>`` appear to be in degrees.

    ## What it does
    Checks ``rpy`` for multiples of 0.5 that exceed one turn (2π).

    ## Why is this bad?
    Angles are in radians: a value of 90 rotates the part by 117 degrees. No reader reports an error.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual>
    -      <origin rpy="90 0 0"/>
    +      <origin rpy="1.5707963 0 0"/>
           <geometry><cylinder radius="0.1" length="0.3"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix assumes that all three angles are in degrees.
    """

    code = "J408"
    name = "rpy-in-degrees"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each origin whose angles appear to be in degrees."""
        for origin in model.elements:
            text = origin.get("rpy") if origin.tag == "origin" else None
            angles = numbers(text) if text else None
            if angles is None or not any(map(_is_degrees, angles)):
                continue
            first = next(filter(_is_degrees, angles))
            value = " ".join(f"{radians(angle):.7g}" for angle in angles)
            message = (
                f'rpy="{text}" appears to be in degrees: {first:g} rad turns the part by {degrees(first) % 360:.0f}°'
            )
            help = f"write angles in radians: {first:g} degrees are {radians(first):.6g} rad"
            fix = new_value(model, origin, "rpy", value, "unsafe", "Convert degrees to radians")
            link = next((each.name for each in model.robot.links if origin in each.element.walk()), None)
            yield self.at(model, origin, message, attribute="rpy", link=link, help=help, fix=fix)


def _is_degrees(angle: float) -> bool:
    return 2 * pi < abs(angle) <= 720.0 and (2.0 * angle).is_integer()
