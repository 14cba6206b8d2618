"""X114 include-cycle."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class IncludeCycle(FaultRule):
    """A file includes itself, or a macro calls itself, without end.

    ## What it does
    Reports chains of includes or macro calls that come back to where they started.

    ## Why is this bad?
    xacro runs until Python's stack is full.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="loop">
        <xacro:loop/>
      </xacro:macro>
      <xacro:loop/>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base"/>
    </robot>
    ```
    """

    code = "X114"
    name = "include-cycle"
    kinds = ("recursion",)
