"""X126 too-large."""

from __future__ import annotations

from urdfkit.lint.rule import FaultRule


class TooLarge(FaultRule):
    """An expression, or what macros make, grows beyond all measure.

    ## What it does
    Reports an expression

    - that makes an integer of more than 10,000 bits, a text of more than 100,000 characters or lists of more than
      100,000 elements in all, those of lists in lists counted,
    - that asks for ``factorial()``, ``comb()`` or ``perm()`` of more than 1,000, or rounds to more than 3,000 digits,
    - that is longer than 10,000 characters, nested deeper than 200, has functions that call each other more than 60
      deep, or makes lists nested more than 60 deep,

    expressions of a file that take more than 1,000,000 steps together, or are more than 200,000; YAML of more than
    500 kB; macros that are called more than 10,000 times, files that are included more than 2,000 times, and macros,
    blocks and includes that make more than 150,000 elements and attributes. Nothing of it is evaluated.

    ## Why is this bad?
    xacro goes on until the memory is full, or for ever.

    ## Example
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual><geometry><sphere radius="${9**9**9}"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
      <link name="base">
        <visual><geometry><sphere radius="${9**9}"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "X126"
    name = "too-large"
    kinds = ("too-large", "too-many")
