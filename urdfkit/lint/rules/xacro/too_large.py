"""X126 too-large."""

from urdfkit.lint.rule import FaultRule


class TooLarge(FaultRule):
    """An expression, macro or include exceeds a resource limit.

    ## What it does
    Reports expressions, macros and includes that exceed a resource limit. xacro expressions are Python from untrusted
    files, so evaluation is bounded and stops at the limit.

    A single expression must not

    - create an integer of more than 10,000 bits, a string of more than 100,000 characters, or lists of more than
      100,000 elements in total, including nested lists
    - call ``factorial()``, ``comb()`` or ``perm()`` with an argument above 1,000, or round to more than 3,000 digits
    - be longer than 10,000 characters, be nested more than 200 levels deep, call functions more than 60 levels deep, or
      create lists nested more than 60 levels deep

    The files of one description must not

    - evaluate more than 200,000 expressions, or take more than 1,000,000 steps to evaluate them
    - load YAML of more than 500 kB
    - call macros more than 10,000 times, or include files more than 2,000 times
    - create more than 150,000 elements and attributes with macros, blocks and includes

    A file must not take more than 10 s of CPU (``--time-limit``) or 1 GB of memory.

    ## Why is this bad?
    Without limits, xacro runs forever or until the memory is exhausted.

    ## Example
    ```diff
     <robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <link name="base">
    -    <visual><geometry><sphere radius="${9**9**9}"/></geometry></visual>
    +    <visual><geometry><sphere radius="${9**9}"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "X126"
    name = "too-large"
    kinds = ("too-large", "too-many")
