"""X127 directive-attribute-unknown."""

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.finding import Edit, Fix, Severity
from urdfkit.lint.rule import FaultRule, Findings, Model


class DirectiveAttribute(FaultRule):
    """A xacro directive has an unknown attribute.

    ## What it does
    Checks the attributes of ``<xacro:property>``, ``<xacro:macro>``, ``<xacro:arg>``, ``<xacro:include>`` and
    conditionals, and checks for commas between the parameters of a macro. To avoid follow-up errors, the linter then
    expands the file as if the attribute were correct.

    ## Why is this bad?
    xacro warns about an unknown attribute and ignores it. A property with ``vlaue``, for example, has no value, and
    expressions that use the property fail. A comma after a macro parameter becomes part of the name of the parameter.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <xacro:property name="length" vlaue="0.4"/>
    +  <xacro:property name="length" value="0.4"/>
       <link name="base"/>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix renames the attribute to the most similar known one (``default`` for the ``value`` of an argument),
    or replaces commas with spaces. No fix is offered if no known attribute is similar.
    """

    code = "X127"
    name = "directive-attribute-unknown"
    severity = "warning"
    fix = "unsafe"
    kinds = ("directive-attribute",)

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding, with a fix if a known attribute is similar."""
        tag, fix = model.tag(fault.position), None
        attribute = tag.attributes.get(fault.attribute or "") if tag is not None else None
        source = model.document(fault.position.file).source
        corrected_value = fault.details.get("value")
        if attribute is not None and corrected_value is not None:
            edit = Edit(source.span(attribute.value_start, attribute.value_end), corrected_value)
            fix = Fix("unsafe", "Separate the parameters with spaces", (edit,))
        elif attribute is not None and fault.name is not None:
            edit = Edit(source.span(attribute.start, attribute.start + len(attribute.name)), fault.name)
            fix = Fix("unsafe", f"Rename to `{fault.name}`", (edit,))
        severity: Severity = "error" if fault.name is not None or corrected_value is not None else "warning"
        yield self.at(model, fault, fault.message, attribute=fault.attribute, fix=fix, severity=severity)
