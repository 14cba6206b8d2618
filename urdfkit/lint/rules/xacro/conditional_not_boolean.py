"""X122 conditional-not-boolean."""

from urdfkit.lint.rule import FaultRule


class ConditionalNotBoolean(FaultRule):
    """The condition of ``<xacro:if>`` or ``<xacro:unless>`` is not a Boolean.

    ## What it does
    Checks for conditions whose value is not ``true``, ``false`` or a number.

    ## Why is this bad?
    xacro aborts with an error.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:property name="finish" value="steel"/>
    -  <xacro:if value="${finish}">
    +  <xacro:if value="${finish == 'steel'}">
         <material name="steel"/>
       </xacro:if>
       <link name="base"/>
     </robot>
    ```
    """

    code = "X122"
    name = "conditional-not-boolean"
    kinds = ("conditional",)
