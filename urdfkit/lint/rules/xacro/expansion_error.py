"""X125 expansion-error."""

from urdfkit.description.xacro.faults import Fault
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import FaultRule, Findings, Model


class ExpansionError(FaultRule):
    """xacro cannot expand the file.

    ## What it does
    Reports the xacro errors that no other rule covers, such as a missing attribute of a directive, an unknown
    directive, or invalid YAML. If a file does not exist because of the default of an argument, the finding is a note,
    because the caller must pass another value.

    ## Why is this bad?
    xacro aborts with an error.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <xacro:property value="0.4"/>
    +  <xacro:property name="length" value="0.4"/>
       <link name="base"/>
     </robot>
    ```
    """

    code = "X125"
    name = "expansion-error"
    kinds = ("other",)

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding; a note if the default of an argument selects no file."""
        path = str(fault.details.get("path", ""))
        if not path:
            yield from super().check(fault, model)
            return
        from urdfkit.lint.facts.required_inputs import argument_in_path

        name = argument_in_path(model, path)
        help = f"pass {name}:=value: its default selects no existing file" if name else None
        severity: Severity | None = "note" if name else None
        yield self.at(model, fault, fault.message, attribute=fault.attribute, help=help, severity=severity)
