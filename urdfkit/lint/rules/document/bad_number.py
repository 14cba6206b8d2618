"""E010 bad-number."""

import re

from urdfkit.description.urdf.robot import Problem
from urdfkit.description.xml.numbers import number
from urdfkit.lint.facts.malformed_expressions import is_unexpanded
from urdfkit.lint.facts.root_cause import is_no_number, root_cause
from urdfkit.lint.finding import Edit, Fix
from urdfkit.lint.rule import Findings, Model, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.facts.root_cause import Place

_COMMA = re.compile(r"\s*,\s*")
_COUNTS = {"xyz": 3, "rpy": 3, "quat_xyzw": 4, "size": 3, "scale": 3, "rgba": 4}


class BadNumber(RobotRule):
    """A numeric value cannot be parsed.

    ## What it does
    Checks that every attribute that holds numbers (``xyz``, ``rpy``, ``size``, ``radius``, ``value``, ``lower`` …) can
    be parsed. Parsing fails for commas between numbers, trailing units, and expressions that were never evaluated. Also
    checks contact parameters, gravity and self-collision of links in ``<gazebo>``.

    ## Why is this bad?
    check_urdf, Pinocchio and MuJoCo reject the whole robot; more lenient readers use zero.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual>
    -      <origin xyz="-0.1, 0, 0"/>
    +      <origin xyz="-0.1 0 0"/>
           <geometry><sphere radius="0.1"/></geometry>
         </visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Safe: the fix replaces commas between numbers with spaces. No fix is offered for other defects.
    """

    code = "E010"
    name = "bad-number"
    fix = "safe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each invalid number, once per property that several values use."""
        reported: set[Place] = set()
        for problem in model.robot.problems:
            if problem.kind != "bad-number" or model.is_unresolved(problem.element, problem.attribute):
                continue
            written = problem.element.get(problem.attribute) if problem.attribute else problem.element.text
            if is_unexpanded(written or ""):
                continue  # Reported by X110.
            place = root_cause(model, problem.element, problem.attribute, is_no_number) if problem.attribute else None
            if place is not None:
                if place not in reported:
                    reported.add(place)
                    help = f"the value is used at {model.shown(problem.element.origin.position)}"
                    yield self.at(model, place[0], problem.message, attribute=place[1], help=help)
                continue
            fix = self._without_commas(problem, model)
            yield self.at(model, problem.element, problem.message, attribute=problem.attribute, fix=fix)

    def _without_commas(self, problem: Problem, model: Model) -> Fix | None:
        written = model.literal(problem.element, problem.attribute) if problem.attribute else None
        if written is None:
            return None
        # Commas are separators only if they separate all numbers; "0,5 0 0" has a decimal comma.
        words = _COMMA.split(written.value.strip())
        if len(words) != _COUNTS.get(written.name) or any(number(word) is None for word in words):
            return None
        span = model.document(problem.origin.position.file).source.span(written.value_start, written.value_end)
        return Fix("safe", "Replace commas with spaces", (Edit(span, " ".join(words)),))
