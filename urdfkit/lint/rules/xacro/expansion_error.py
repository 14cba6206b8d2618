"""X125 expansion-error."""

from urdfkit.lint.rule import FaultRule


class ExpansionError(FaultRule):
    """xacro cannot expand the file.

    ## What it does
    Reports the xacro errors that no other rule covers, such as a missing attribute of a directive, an unknown
    directive, or invalid YAML.

    ## Why is this bad?
    xacro aborts with an error.

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
