"""X106 undefined-arg."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class UndefinedArgument(FaultRule):
    """``$(arg …)`` asks for an argument that was neither declared nor given.

    ## What it does
    Reports arguments without ``<xacro:arg>`` default that are not given as ``name:=value``. Where an included file is
    missing, which may declare them, that is only a note.

    ## Why is this bad?
    The description expands only for those who know which arguments to give.

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
