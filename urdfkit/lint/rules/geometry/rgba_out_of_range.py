"""G614 rgba-out-of-range."""

from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule

ROUNDING = 0.01
"""Tolerance for rounded components."""


class RgbaOutOfRange(RobotRule):
    """A colour has components outside the range 0 to 1.

    ## What it does
    Checks the ``rgba`` of all materials.

    ## Why is this bad?
    URDF colours range from 0 to 1, not from 0 to 255: a component above 1 counts as 1, and the shape is white.

    ## Example
    ```diff
     <robot name="arm">
       <material name="orange">
    -    <color rgba="255 127.5 0 1"/>
    +    <color rgba="1 0.5 0 1"/>
       </material>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Safe: the fix divides the components by 255 if all are within 0 to 255 and one is above 2. No fix is offered for
    other colours.
    """

    code = "G614"
    name = "rgba-out-of-range"
    severity = "warning"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each colour out of range."""
        inside = [visual.material for link in model.robot.links for visual in link.visuals]
        for material in (*model.robot.materials, *inside):
            rgba = material.rgba if material is not None else None
            color = material.element.find("color") if material is not None else None
            if rgba is None or color is None or all(-ROUNDING <= part <= 1.0 + ROUNDING for part in rgba):
                continue
            fix = None
            if min(rgba) >= 0.0 and 2.0 < max(rgba) <= 255.0:
                alpha = rgba[3] if rgba[3] <= 1.0 else rgba[3] / 255.0
                value = " ".join(f"{part:.4g}" for part in (*(part / 255.0 for part in rgba[:3]), alpha))
                fix = new_value(model, color, "rgba", value, "safe", f"Replace with {value}")
            message = f'rgba="{color.get("rgba")}" has components outside the range 0 to 1'
            help = "write each component as a number from 0 to 1"
            yield self.at(model, color, message, attribute="rgba", help=help, fix=fix)
