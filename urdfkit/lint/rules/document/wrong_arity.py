"""E011 wrong-arity."""

from urdfkit.lint.fix_builders import new_value
from urdfkit.lint.rule import Findings, Model, RobotRule


class WrongArity(RobotRule):
    """An attribute has too many or too few numbers.

    ## What it does
    Checks that ``xyz``, ``rpy``, ``size`` and ``scale`` have three numbers, ``rgba`` and ``quat_xyzw`` four, and
    scalar attributes one.

    ## Why is this bad?
    check_urdf at most warns and drops the geometry of the link; other readers reject the robot.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual>
    -      <geometry><box size="0.1 0.1"/></geometry>
    +      <geometry><box size="0.1 0.1 0.1"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix applies a single scale to all three axes. No fix is offered for other attributes.
    """

    code = "E011"
    name = "wrong-arity"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each list of numbers that is too long or too short."""
        for problem in model.robot.problems:
            if problem.kind != "wrong-arity" or model.is_unresolved(problem.element, problem.attribute):
                continue
            fix = None
            words = (problem.element.get(problem.attribute) or "").split() if problem.attribute else []
            if problem.attribute == "scale" and len(words) == 1:
                value = " ".join(words * 3)
                fix = new_value(model, problem.element, "scale", value, "unsafe", "Apply the scale to all three axes")
            placed = [joint for joint in model.robot.joints if problem.element in joint.element.children]
            names = tuple(name for joint in placed for name in (joint.name, joint.child) if name)
            yield self.at(model, problem.element, problem.message, attribute=problem.attribute, fix=fix, names=names)
