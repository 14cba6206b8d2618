"""X113 include-not-found."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class IncludeNotFound(FaultRule):
    """An included file, or the package it is in, is not there.

    ## What it does
    Reports ``<xacro:include>`` whose file does not exist and ``$(find …)`` whose package is found neither in the
    workspace nor in the environment. The rest is linted without it.

    ## Why is this bad?
    xacro stops. What the file would have defined is missing from then on.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <xacro:include filename="wheels_that_are_nowhere.xacro"/>
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

    code = "X113"
    name = "include-not-found"
    kinds = ("include-not-found", "package-not-found")
