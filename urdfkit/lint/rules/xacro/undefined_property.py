"""X104 undefined-property."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.faults import Fault


class UndefinedProperty(FaultRule):
    """An expression uses a property that is not defined.

    ## What it does
    Reports names in ``${…}`` that no property, macro parameter or function has.

    ## Why is this bad?
    xacro stops; its message names the expression, but neither attribute nor column.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="length" value="0.4"/>
      <link name="base">
        <visual><geometry><box size="${lenght} 1 1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="length" value="0.4"/>
      <link name="base">
        <visual><geometry><box size="${length} 1 1"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "X104"
    name = "undefined-property"
    kinds = ("undefined-property",)
    may_be_elsewhere = True

    def claims(self, fault: Fault) -> bool:
        """Return whether the property is defined nowhere, not just later."""
        return fault.kind == "undefined-property" and fault.defined_at is None
