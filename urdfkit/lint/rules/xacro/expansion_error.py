"""X125 expansion-error."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class ExpansionError(FaultRule):
    """xacro could not expand the file for another reason.

    ## What it does
    Reports what xacro says about anything no other rule is about: an attribute a directive lacks or does not have, an
    unknown directive, YAML that cannot be read.

    ## Why is this bad?
    xacro stops.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property value="0.4"/>
      <link name="base"/>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:property name="length" value="0.4"/>
      <link name="base"/>
    </robot>
    ```
    """

    code = "X125"
    name = "expansion-error"
    kinds = ("other",)
