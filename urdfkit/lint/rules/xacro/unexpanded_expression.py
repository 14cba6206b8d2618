"""X110 unexpanded-expression."""

from __future__ import annotations

from urdfkit.lint.edits import new_text, new_value
from urdfkit.lint.expressions import is_unexpanded, righted
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class UnexpandedExpression(RobotRule):
    """An expression is written so that xacro does not evaluate it.

    ## What it does
    Looks for ``{$…}``, ``$ {…}`` and ``${…`` without its end in what came out of xacro.

    ## Why is this bad?
    xacro copies it as it is: a reader that wants a number refuses the robot, and names are other ones than you
    meant.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual>
          <origin rpy="{$-pi/2} 0 0"/>
          <geometry><cylinder radius="0.1" length="0.2"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual>
          <origin rpy="${-pi/2} 0 0"/>
          <geometry><cylinder radius="0.1" length="0.2"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Safe for ``{$…}`` and ``$ {…}``, which mean nothing else; an end that is missing is left to you.
    """

    code = "X110"
    name = "unexpanded-expression"
    fix = "safe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each expression that was copied."""
        if not any(is_unexpanded(source.text) for source in model.expanded.sources.values()):
            return
        handed_on = False
        for finding in self._handed_on(model):
            handed_on = True
            yield finding
        for element in model.robot.element.walk():
            for attribute, value in element.attributes.items():
                if is_unexpanded(value) and not model.is_unresolved(element, attribute):
                    if handed_on and model.literal(element, attribute) is None:
                        continue  # It comes from a property or a parameter, where it is found already.
                    right = righted(value)
                    fix = (
                        new_value(model, element, attribute, right, "safe", f"Write `{right}`")
                        if right != value
                        else None
                    )
                    message = f'{attribute}="{value}" holds an expression that xacro does not evaluate'
                    yield self.at(model, element, message, attribute=attribute, help="it is written ${…}", fix=fix)
            if element.text and is_unexpanded(element.text) and not model.is_unresolved(element):
                right = righted(element.text)
                fix = new_text(model, element, right, "safe", f"Write `{right}`") if right != element.text else None
                message = f"<{element.tag}> holds an expression that xacro does not evaluate: `{element.text}`"
                yield self.at(model, element, message, help="it is written ${…}", fix=fix)

    def _handed_on(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each property, and each argument of a macro call, that is handed on as it stands."""
        for file, source in model.expanded.sources.items():
            if not is_unexpanded(source.text):
                continue
            for tag in model.document(file).walk():
                if not tag.name.startswith("xacro:"):
                    continue
                for attribute, written in tag.attributes.items():
                    right = righted(written.value)
                    if right == written.value:
                        continue
                    edit = Edit(source.span(written.value_start, written.value_end), right)
                    fix = Fix("safe", f"Write `{right}`", (edit,))
                    message = f'{attribute}="{written.value}" holds an expression that xacro does not evaluate'
                    at = source.position(tag.start)
                    yield self.at(model, at, message, attribute=attribute, help="it is written ${…}", fix=fix)
