"""X127 directive-attribute-unknown."""

from __future__ import annotations

from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import FaultRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.faults import Fault
    from urdfkit.lint.finding import Finding, Severity
    from urdfkit.lint.model import Model


class DirectiveAttribute(FaultRule):
    """A directive of xacro has no such attribute.

    ## What it does
    Looks at the attributes of ``<xacro:property>``, ``<xacro:macro>``, ``<xacro:arg>``, ``<xacro:include>`` and of
    conditions, and for commas between the parameters of a macro. The file is then read as if it were written right, so
    that nothing follows from it.

    ## Why is this bad?
    xacro warns of an unknown attribute and leaves it out: a property with ``vlaue`` has no value, and an expression
    that uses it fails somewhere else. With a comma behind it a parameter is called ``name,``.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="length" vlaue="0.4"/>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="length" value="0.4"/>
      <link name="base"/>
    </robot>
    ```

    ## Fix safety
    Unsafe: the attribute is called what its name is nearest to (``default`` for the ``value`` of an argument), and
    commas become blanks; where nothing is near it is left to you.
    """

    code = "X127"
    name = "directive-attribute-unknown"
    severity = "warning"
    fix = "unsafe"
    kinds = ("directive-attribute",)

    def check(self, fault: Fault, model: Model) -> Iterator[Finding]:
        """Yield the finding, with its fix where the name is near another."""
        tag, fix = model.tag(fault.position), None
        written = tag.attributes.get(fault.attribute or "") if tag is not None else None
        source = model.document(fault.position.file).source
        value = fault.details.get("value")
        if written is not None and value is not None:
            edit = Edit(source.span(written.value_start, written.value_end), value)
            fix = Fix("unsafe", "Separate them by blanks", (edit,))
        elif written is not None and fault.name is not None:
            edit = Edit(source.span(written.start, written.start + len(written.name)), fault.name)
            fix = Fix("unsafe", f"Call it `{fault.name}`", (edit,))
        severity: Severity = "error" if fault.name is not None or value is not None else "warning"
        yield self.at(model, fault, fault.message, attribute=fault.attribute, fix=fix, severity=severity)
