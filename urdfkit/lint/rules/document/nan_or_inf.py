"""E012 nan-or-inf."""

from urdfkit.description.urdf.values import LARGEST as BEYOND
from urdfkit.description.xml.numbers import numbers
from urdfkit.lint.model.xacro_prefix import URDF_ATTRIBUTES
from urdfkit.lint.rule import Findings, Model, RobotRule

LARGEST = 1e10
"""Largest plausible value, in SI units."""

_TAGS = ("origin", "mass", "inertia", "box", "cylinder", "sphere", "capsule")


class NanOrInf(RobotRule):
    """A pose, size, mass or inertia is not finite or is implausibly large.

    ## What it does
    Checks for ``nan`` and ``inf``, and for poses, sizes, masses and inertias with a magnitude above 1e10, which some
    exporters write instead of infinity. Joint limits may be infinite.

    ## Why is this bad?
    A single such value turns all positions into NaN, and simulators stop or diverge.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual>
    -      <origin xyz="0 0 nan"/>
    +      <origin xyz="0 0 0"/>
           <geometry><sphere radius="0.1"/></geometry>
         </visual>
       </link>
     </robot>
    ```
    """

    code = "E012"
    name = "nan-or-inf"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each value that is not finite or implausibly large."""
        for problem in model.robot.problems:
            if problem.kind == "not-finite":
                yield self.at(model, problem.element, problem.message, attribute=problem.attribute)
        for element in model.elements:
            for attribute in URDF_ATTRIBUTES[element.tag] if element.tag in _TAGS else ():
                text = element.get(attribute)
                # Only text with an exponent or at least eleven characters can be that large.
                if text is None or (len(text) < 11 and "e" not in text.lower()):
                    continue
                if any(LARGEST < abs(value) <= BEYOND for value in numbers(text) or ()):
                    message = f'{attribute}="{text}" of <{element.tag}> has a value of magnitude above 1e10'
                    help = "write the real value in SI units"
                    yield self.at(model, element, message, attribute=attribute, help=help)
