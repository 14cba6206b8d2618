"""X122 conditional-not-boolean."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class ConditionalNotBoolean(FaultRule):
    """The value of ``<xacro:if>`` is neither true nor false.

    ## What it does
    Reports conditions that come out as something else than ``true``, ``false`` or a number.

    ## Why is this bad?
    xacro stops.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="gripper" value="parallel"/>
      <xacro:if value="${gripper}">
        <link name="finger"/>
      </xacro:if>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="gripper" value="parallel"/>
      <xacro:if value="${gripper == 'parallel'}">
        <link name="finger"/>
      </xacro:if>
      <link name="base"/>
    </robot>
    ```
    """

    code = "X122"
    name = "conditional-not-boolean"
    kinds = ("conditional",)
