"""X106 undefined-arg."""

from urdfkit.description.xacro.faults import Fault
from urdfkit.errors import did_you_mean
from urdfkit.lint.rule import FaultRule, Findings, Model


class UndefinedArgument(FaultRule):
    """``$(arg …)`` uses an argument without a value.

    ## What it does
    Checks for arguments that have neither a default in ``<xacro:arg>`` nor a value passed as ``name:=value``. The
    finding is a note if ``<xacro:arg>`` declares the argument without a default, if a launch file of these packages
    passes the argument, or if a missing included file may declare it.

    ## Why is this bad?
    xacro aborts if a caller does not pass the argument.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    +  <xacro:arg name="prefix" default=""/>
       <link name="$(arg prefix)base"/>
     </robot>
    ```
    """

    code = "X106"
    name = "undefined-arg"
    kinds = ("undefined-arg",)
    may_be_elsewhere = True

    def check(self, fault: Fault, model: Model) -> Findings:
        """Yield the finding; a note for an argument that users of the robot pass."""
        from urdfkit.lint.facts.required_inputs import is_required_argument

        name = fault.name or ""
        if model.missing_file or did_you_mean(name, fault.candidates) or not is_required_argument(model, name):
            yield from super().check(fault, model)
        else:
            message = f"argument `{name}` has no value, but the robot requires one"
            help = f"pass {name}:=value to lint the robot with it"
            yield self.at(model, fault, message, attribute=fault.attribute, help=help, severity="note", names=(name,))
