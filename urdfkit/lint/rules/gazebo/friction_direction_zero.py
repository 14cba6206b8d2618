"""Z814 fdir1-zero."""

from __future__ import annotations

from urdfkit.description.numbers import numbers
from urdfkit.lint.edits import without_element
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class FrictionDirectionZero(RobotRule):
    """The direction of friction is no direction.

    ## What it does
    Looks for ``<fdir1>`` of ``0 0 0``.

    ## Why is this bad?
    Friction is spread along a vector without length; physics engines divide by it, or ignore friction.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <fdir1>0 0 0</fdir1>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <fdir1>1 0 0</fdir1>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Safe: without it friction is the same in all directions, which zero comes to at best.
    """

    code = "Z814"
    name = "fdir1-zero"
    severity = "warning"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each direction without length."""
        for block in model.robot.gazebo:
            for element in block.element.walk():
                if element.tag != "fdir1":
                    continue
                values = numbers(element.text or element.get("value") or "")
                if values and not any(values):
                    fix = without_element(model, element, "safe", "Take it away")
                    yield self.at(model, element, "<fdir1> is 0 0 0, which is no direction", fix=fix)
