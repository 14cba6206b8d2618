"""X114 include-cycle."""

from urdfkit.lint.rule import FaultRule


class IncludeCycle(FaultRule):
    """A file includes itself, or a macro calls itself, in an infinite recursion.

    ## What it does
    Checks for cycles of includes and macro calls.

    ## Why is this bad?
    xacro recurses until it exceeds the recursion limit of Python.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
    -  <xacro:macro name="loop">
    -    <xacro:loop/>
    -  </xacro:macro>
    -  <xacro:loop/>
       <link name="base"/>
     </robot>
    ```
    """

    code = "X114"
    name = "include-cycle"
    kinds = ("recursion",)
