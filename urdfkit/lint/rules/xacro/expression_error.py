"""X124 expression-error."""

from __future__ import annotations

from urdfkit.lint.blamed import culprit, is_no_number
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class ExpressionError(FaultRule):
    """An expression cannot be evaluated.

    ## What it does
    Reports ``${…}`` that is no Python expression, or fails: a division by zero, a function with a wrong argument. Where
    it fails because a property or argument is nearly a number (``O.4``, ``0,4``), that is told where it is written.

    ## Why is this bad?
    xacro stops, or the text reaches the robot as it stands.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual><geometry><sphere radius="${1/0}"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual><geometry><sphere radius="${1/2}"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "X124"
    name = "expression-error"
    kinds = ("bad-expression",)

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; where a property is nearly a number, one for all that use it."""
        text = f"${{{fault.expression}}}"
        place = culprit(model, text, fault.expansions, is_no_number) if fault.expression else None
        if place is None:
            yield from super().check(fault, model)
        else:
            tag = model.tag(place[0])
            value = tag.attributes[place[1]].value if tag is not None else ""
            used = f"it is used at {model.shown(fault.position)}: `{text}`"
            yield self.at(
                model, place[0], f"`{value}` is reckoned with and is no number", attribute=place[1], help=used
            )
