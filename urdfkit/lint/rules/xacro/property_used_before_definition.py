"""X105 property-used-before-definition."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class PropertyUsedBeforeDefinition(FaultRule):
    """A property is used before it is defined.

    ## What it does
    Reports names in ``${…}`` that are defined further down, or in a file that is included later.

    ## Why is this bad?
    xacro reads from top to bottom (the only mode since ROS Melodic) and stops at the first use.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="${side}_arm"/>
      <xacro:property name="side" value="left"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="side" value="left"/>
      <link name="${side}_arm"/>
    </robot>
    ```
    """

    code = "X105"
    name = "property-used-before-definition"
    kinds = ("undefined-property",)

    def claims(self, fault: Fault) -> bool:
        """Return whether the property is defined, but too late."""
        return fault.kind == "undefined-property" and fault.defined_at is not None

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding; its help says where the definition is."""
        definition = f" ({model.shown(fault.defined_at)})" if fault.defined_at is not None else ""
        yield self.at(
            model,
            fault,
            f"property `{fault.name}` is used before it is defined",
            attribute=fault.attribute,
            help=f"move the definition{definition} above this use",
        )
