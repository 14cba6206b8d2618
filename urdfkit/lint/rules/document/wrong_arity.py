"""E011 wrong-arity."""

from __future__ import annotations

from urdfkit.lint.edits import new_value
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class WrongArity(RobotRule):
    """There are more or fewer numbers than there have to be.

    ## What it does
    Counts the numbers in ``xyz``, ``rpy``, ``size``, ``scale`` (three), ``rgba`` (four) and in those that hold one.

    ## Why is this bad?
    check_urdf warns at most and keeps the link without its geometry; others refuse the robot.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <geometry><box size="0.1 0.1"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <geometry><box size="0.1 0.1 0.1"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: one number for a scale is taken for all three axes; the rest is left to you.
    """

    code = "E011"
    name = "wrong-arity"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each list of numbers that is too long or too short."""
        for problem in model.robot.problems:
            if problem.kind != "wrong-arity" or model.is_unresolved(problem.element, problem.attribute):
                continue
            fix = None
            words = (problem.element.get(problem.attribute) or "").split() if problem.attribute else []
            if problem.attribute == "scale" and len(words) == 1:
                value = " ".join(words * 3)
                fix = new_value(model, problem.element, "scale", value, "unsafe", "Scale all three axes alike")
            yield self.at(model, problem.element, problem.message, attribute=problem.attribute, fix=fix)
