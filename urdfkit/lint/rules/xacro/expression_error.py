"""X124 expression-error."""

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.facts.root_cause import cause_in_text, is_no_number
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import FaultRule, Findings, Model


class ExpressionError(FaultRule):
    """An expression cannot be evaluated.

    ## What it does
    Checks for ``${…}`` expressions that are not valid Python, or that fail, such as a division by zero or a function
    call with an invalid argument. If the cause is a property or argument with a mistyped number (``O.4``, ``0,4``), the
    rule reports the definition of the property or argument instead.

    ## Why is this bad?
    xacro aborts with an error, or copies the expression to the robot unchanged.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="base">
    -    <visual><geometry><sphere radius="${1/0}"/></geometry></visual>
    +    <visual><geometry><sphere radius="${1/2}"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "X124"
    name = "expression-error"
    kinds = ("bad-expression",)

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding, at the definition of a malformed number if that is the cause."""
        text = f"${{{fault.expression}}}"
        cause = cause_in_text(model, text, fault.expansions, is_no_number) if fault.expression else None
        if cause is None:
            kind = "load_yaml" if "load_yaml" in (fault.expression or "") else ""
            for finding in super().check(fault, model):
                yield Finding(**{**finding.__dict__, "kind": kind})
        else:
            tag = model.tag(cause[0])
            value = tag.attributes[cause[1]].value if tag is not None else ""
            help = f"write a number; `{text}` uses the value at {model.shown(fault.position)}"
            message = f"`{value}` is used in an expression, but is not a number"
            yield self.at(model, cause[0], message, attribute=cause[1], help=help)
