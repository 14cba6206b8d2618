"""X104 undefined-property."""

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.rule import FaultRule


class UndefinedProperty(FaultRule):
    """An expression uses an undefined property.

    ## What it does
    Checks for names in ``${…}`` that are neither a property, a macro parameter nor a function.

    ## Why is this bad?
    xacro aborts with an error that contains the expression, but neither the attribute nor the column.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:property name="length" value="0.4"/>
       <link name="base">
    -    <visual><geometry><box size="${lenght} 1 1"/></geometry></visual>
    +    <visual><geometry><box size="${length} 1 1"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "X104"
    name = "undefined-property"
    kinds = ("undefined-property",)
    may_be_elsewhere = True

    def claims(self, fault: Fault) -> bool:
        """Return whether the property has no definition, not even a later one."""
        return fault.kind == "undefined-property" and fault.defined_at is None
