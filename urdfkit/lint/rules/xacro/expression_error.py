"""X124 expression-error."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class ExpressionError(FaultRule):
    """An expression cannot be evaluated.

    ## What it does
    Reports ``${…}`` that is no Python expression, or fails: a division by zero, a function with a wrong argument.

    ## Why is this bad?
    xacro stops, or the text reaches the robot as it stands.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual><geometry><sphere radius="${1/0}"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual><geometry><sphere radius="${1/2}"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "X124"
    name = "expression-error"
    kinds = ("bad-expression",)
