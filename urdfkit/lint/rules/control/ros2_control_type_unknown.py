"""C716 ros2-control-type-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import meant, new_value
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_TYPES = ("system", "sensor", "actuator")
"""What the resource manager of ros2_control asks for."""


class Ros2ControlTypeUnknown(RobotRule):
    """The type of ``<ros2_control>`` is none of those there are.

    ## What it does
    Looks for ``<ros2_control type="…">`` that is not ``system``, ``sensor`` or ``actuator``.

    ## Why is this bad?
    The resource manager passes over the whole block: no controller finds its interfaces.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base"/>
      <ros2_control name="arm" type="sytem">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
      </ros2_control>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base"/>
      <ros2_control name="arm" type="system">
        <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
      </ros2_control>
    </robot>
    ```

    ## Fix safety
    Safe: it is one letter or two from the right word, or the same in another case.
    """

    code = "C716"
    name = "ros2-control-type-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each block of an unknown type."""
        for block in model.robot.ros2_control:
            written = block.element.get("type")
            if written is None or written in _TYPES or "$" in written:
                continue
            near, hint = meant(written, _TYPES)
            hint = hint or f"; it is one of {', '.join(_TYPES)}"
            yield self.at(
                model,
                block.element,
                f"<ros2_control> has no type `{written}`{hint}",
                attribute="type",
                fix=new_value(model, block.element, "type", near, "safe", f"Write `{near}`") if near else None,
            )
