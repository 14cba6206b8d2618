"""X103 unknown-macro."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class UnknownMacro(FaultRule):
    """A macro is called that is not defined there.

    ## What it does
    Reports calls of macros that no file defines before the call.

    ## Why is this bad?
    xacro stops; its message names the macro but not the line of the call.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name">
        <link name="${name}"/>
      </xacro:macro>
      <xacro:fram name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:macro name="frame" params="name">
        <link name="${name}"/>
      </xacro:macro>
      <xacro:frame name="base"/>
    </robot>
    ```
    """

    code = "X103"
    name = "unknown-macro"
    kinds = ("undefined-macro",)
    may_be_elsewhere = True
