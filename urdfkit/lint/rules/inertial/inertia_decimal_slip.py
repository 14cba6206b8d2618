"""I506 inertia-decimal-slip."""

from __future__ import annotations

from urdfkit.lint.edits import new_value
from urdfkit.lint.rule import RobotRule
from urdfkit.lint.tensor import tensor_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

AGREE = 1.7
"""Moments within this factor of those of an evenly filled body agree with it."""

CLOSE = 1.5
"""So near to it a moment comes by a power of ten."""


class InertiaDecimalSlip(RobotRule):
    """One moment of inertia is off by a power of ten.

    ## What it does
    Compares the diagonal of the tensor with that of the link's shapes, filled evenly. Where two moments agree and
    the third is off by ten, a hundred or a thousand, a zero was lost.

    ## Why is this bad?
    The link turns about one axis as if it were much lighter, or heavier, than it is.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <inertial>
          <mass value="3"/>
          <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.0052"/>
        </inertial>
        <visual><geometry><box size="0.32 0.31 0.3"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <inertial>
          <mass value="3"/>
          <inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.052"/>
        </inertial>
        <visual><geometry><box size="0.32 0.31 0.3"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the moment is multiplied, but the others may be as wrong.
    """

    code = "I506"
    name = "inertia-decimal-slip"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each moment that is a power of ten off, the others being right."""
        for link in model.robot.links:
            inertial = link.inertial
            if inertial is None or not inertial.mass or inertial.mass < 0.0 or inertial.inertia is None:
                continue
            inertia = inertial.inertia
            written = {"ixx": inertia.ixx, "iyy": inertia.iyy, "izz": inertia.izz}
            extent = model.extents.get(link.name)
            if extent is None or min(written.values()) <= 0.0:
                continue
            values = tensor_of(link, extent, inertial.mass)
            if values is None or min(values[0], values[3], values[5]) <= 0.0:
                continue
            expected = {"ixx": values[0], "iyy": values[3], "izz": values[5]}
            ratios = {name: written[name] / expected[name] for name in written}
            off = [name for name, ratio in ratios.items() if not 1.0 / AGREE < ratio < AGREE]
            if len(off) != 1:
                continue
            name = off[0]
            powers = (-3, -2, -1, 1, 2, 3)
            power = next((k for k in powers if 1.0 / CLOSE < ratios[name] * 10.0**k < CLOSE), None)
            if power is not None:
                right = f"{written[name] * 10.0**power:.6g}"
                yield self.at(
                    model,
                    inertia.element,
                    f"link `{link.name}`: {name}={written[name]:g} is off by {10 ** abs(power)} beside the others",
                    attribute=name,
                    link=link.name,
                    help=f"shape and mass give {written[name] / ratios[name]:.3g}: is {right} meant?",
                    fix=new_value(model, inertia.element, name, right, "unsafe", f"Write {right}"),
                )
