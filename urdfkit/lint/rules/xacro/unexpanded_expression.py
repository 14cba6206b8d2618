"""X110 unexpanded-expression."""

from urdfkit.lint.facts.malformed_expressions import correct_escapes, is_unexpanded
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.fix_builders import new_text, new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class UnexpandedExpression(RobotRule):
    """Malformed ``${…}`` syntax prevents the evaluation of an expression.

    ## What it does
    Checks the output of xacro for ``{$…}``, ``$ {…}`` and unterminated ``${…``.

    ## Why is this bad?
    xacro copies the expression unchanged. Parsers that expect a number reject the robot, and names contain the literal
    text of the expression.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="base">
         <visual>
    -      <origin rpy="{$-pi/2} 0 0"/>
    +      <origin rpy="${-pi/2} 0 0"/>
           <geometry><cylinder radius="0.1" length="0.2"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Safe for ``{$…}`` and ``$ {…}``, which have no other meaning. No fix is offered for an unterminated ``${…``.
    """

    code = "X110"
    name = "unexpanded-expression"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each expression that xacro does not evaluate."""
        if not any(is_unexpanded(source.text) for source in model.expanded.sources.values()):
            return
        is_reported_at_source = False
        for finding in self._in_xacro_elements(model):
            is_reported_at_source = True
            yield finding
        for element in model.robot.element.walk():
            for attribute, value in element.attributes.items():
                if is_unexpanded(value) and not model.is_unresolved(element, attribute):
                    if is_reported_at_source and model.literal(element, attribute) is None:
                        continue  # Reported at the property or argument that contains it.
                    corrected = correct_escapes(value)
                    fix = new_value(model, element, attribute, corrected, "safe") if corrected != value else None
                    message = f'xacro does not evaluate the expression in {attribute}="{value}"'
                    yield self.at(model, element, message, attribute=attribute, help="write ${…}", fix=fix)
            if element.text and is_unexpanded(element.text) and not model.is_unresolved(element):
                corrected = correct_escapes(element.text)
                fix = new_text(model, element, corrected, "safe") if corrected != element.text else None
                message = f"xacro does not evaluate the expression `{element.text}` in <{element.tag}>"
                yield self.at(model, element, message, help="write ${…}", fix=fix)

    def _in_xacro_elements(self, model: Model) -> Findings:
        """Yield a finding for each malformed expression in a directive or in an argument of a macro call."""
        for file, source in model.expanded.sources.items():
            if not is_unexpanded(source.text):
                continue
            for tag in model.document(file).walk():
                if not tag.name.startswith("xacro:"):
                    continue
                for attribute, written_value in tag.attributes.items():
                    corrected = correct_escapes(written_value.value)
                    if corrected == written_value.value:
                        continue
                    edit = Edit(source.span(written_value.value_start, written_value.value_end), corrected)
                    fix = Fix("safe", f"Replace with `{corrected}`", (edit,))
                    message = f'xacro does not evaluate the expression in {attribute}="{written_value.value}"'
                    position = source.position(tag.start)
                    yield self.at(model, position, message, attribute=attribute, help="write ${…}", fix=fix)
