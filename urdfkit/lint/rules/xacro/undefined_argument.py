"""X106 undefined-arg."""

from urdfkit.lint.rule import FaultRule


class UndefinedArgument(FaultRule):
    """``$(arg …)`` uses an argument without a value.

    ## What it does
    Checks for arguments that have neither a default in ``<xacro:arg>`` nor a value passed as ``name:=value``. If an
    included file that may declare the argument is missing, this is a note.

    ## Why is this bad?
    xacro aborts unless every caller passes the argument.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="$(arg prefix)base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:arg name="prefix" default=""/>
      <link name="$(arg prefix)base"/>
    </robot>
    ```
    """

    code = "X106"
    name = "undefined-arg"
    kinds = ("undefined-arg",)
    may_be_elsewhere = True
