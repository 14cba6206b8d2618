"""E014 required-child-or-attr-missing."""

from urdfkit.lint.rule import Findings, Model, RobotRule

_OTHER_RULES = frozenset(
    (
        ("robot", "name"),
        ("joint", "type"),
        ("limit", "effort"),
        ("limit", "velocity"),
        ("safety_controller", "k_velocity"),
    )
)
"""Attributes whose absence other rules report."""


class RequiredMissing(RobotRule):
    """A required element or attribute is missing.

    ## What it does
    Checks for missing elements and attributes that URDF requires: a geometry and its sizes, the file name of a mesh,
    the value of a mass, a complete inertia tensor, the parent and child of a joint, and names.

    ## Why is this bad?
    check_urdf only warns about some missing parts, and drops the geometry or the inertia. Other readers reject the
    robot.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual>
    -      <geometry><cylinder radius="0.1"/></geometry>
    +      <geometry><cylinder radius="0.1" length="0.2"/></geometry>
         </visual>
       </link>
     </robot>
    ```
    """

    code = "E014"
    name = "required-child-or-attr-missing"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each missing element or attribute that no other rule reports."""
        for problem in model.robot.problems:
            if problem.kind != "missing" or (problem.element.tag, problem.attribute) in _OTHER_RULES:
                continue
            if problem.element.tag == "texture":
                continue  # Exporters write empty textures, which every reader ignores.
            if model.is_incomplete and problem.attribute is None:
                continue  # The element may be in a part that could not be expanded.
            kind = "attribute" if problem.attribute is not None else ""
            yield self.at(model, problem.element, problem.message, attribute=problem.attribute, kind=kind)
