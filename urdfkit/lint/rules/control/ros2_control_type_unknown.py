"""C716 ros2-control-type-unknown."""

from urdfkit.lint.fix_builders import meant, new_value
from urdfkit.lint.rule import NOT_GAZEBO, Findings, Model, RobotRule

_TYPES = ("system", "sensor", "actuator")
"""The types that the resource manager of ros2_control accepts."""


class Ros2ControlTypeUnknown(RobotRule):
    """A ``<ros2_control>`` block has an unknown type, or no type.

    ## What it does
    Checks for ``<ros2_control type="…">`` values other than ``system``, ``sensor`` and ``actuator``, and for blocks
    without ``type``.

    ## Why is this bad?
    The resource manager skips a block of unknown type, so no controller finds its interfaces. It rejects the whole
    robot if a block has no type.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base"/>
    -  <ros2_control name="arm" type="sytem">
    +  <ros2_control name="arm" type="system">
         <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
       </ros2_control>
     </robot>
    ```

    ## Fix safety
    Safe: the value differs from a known type only in case or by one or two letters.
    """

    code = "C716"
    name = "ros2-control-type-unknown"
    fix = "safe"
    not_for = NOT_GAZEBO

    def check(self, model: Model) -> Findings:
        """Yield a finding for each block of an unknown type."""
        for block in model.robot.ros2_control:
            value = block.element.get("type")
            if value is None:
                message = "<ros2_control> has no `type`"
                help = f"add the attribute `type` with one of the values {', '.join(_TYPES)}"
                yield self.at(model, block.element, message, help=help)
                continue
            if value in _TYPES or "$" in value:
                continue
            near, hint = meant(value, _TYPES)
            hint = hint or f"; use one of {', '.join(_TYPES)}"
            message = f"unknown <ros2_control> type `{value}`" + hint
            fix = new_value(model, block.element, "type", near, "safe")
            yield self.at(model, block.element, message, attribute="type", fix=fix)
