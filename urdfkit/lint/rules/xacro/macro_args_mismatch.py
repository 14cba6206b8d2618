"""X107 macro-args-mismatch."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class MacroArgsMismatch(FaultRule):
    """A macro is called with other arguments than it has.

    ## What it does
    Reports calls that leave out a parameter without default, name a parameter the macro does not have, or bring too few
    or too many blocks.

    ## Why is this bad?
    xacro stops with "Undefined parameters" and does not say which call is meant.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name parent">
        <link name="${parent}_${name}"/>
      </xacro:macro>
      <xacro:frame name="tool"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name parent">
        <link name="${parent}_${name}"/>
      </xacro:macro>
      <xacro:frame name="tool" parent="hand"/>
    </robot>
    ```
    """

    code = "X107"
    name = "macro-args-mismatch"
    kinds = ("macro-arguments", "undefined-block")
