"""E014 required-child-or-attr-missing."""

from __future__ import annotations

from urdfkit.description.robot import JOINT_TYPES
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

_ELSEWHERE = frozenset(
    (
        ("robot", "name"),
        ("joint", "type"),
        ("limit", "effort"),
        ("limit", "velocity"),
        ("safety_controller", "k_velocity"),
    )
)


class RequiredMissing(RobotRule):
    """Something is missing that has to be there.

    ## What it does
    Reports what URDF requires: a geometry and its sizes, the file name of a mesh, the value of a mass, a whole
    inertia tensor, parent and child of a joint, names.

    ## Why is this bad?
    check_urdf only warns of some of it, and drops the geometry or the inertia; others refuse the robot.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <geometry><cylinder radius="0.1"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual>
          <geometry><cylinder radius="0.1" length="0.2"/></geometry>
        </visual>
      </link>
    </robot>
    ```
    """

    code = "E014"
    name = "required-child-or-attr-missing"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each thing that is missing, those that have rules of their own left out."""
        for problem in model.robot.problems:
            if problem.kind != "missing" or (problem.element.tag, problem.attribute) in _ELSEWHERE:
                continue
            if problem.element.tag == "texture":
                continue  # Exporters leave an empty one, which every reader takes for none.
            if model.is_incomplete and problem.attribute is None:
                continue  # It may be in what could not be expanded.
            if problem.element.tag == "joint" and problem.message.partition(": ")[2].endswith(", ".join(JOINT_TYPES)):
                continue
            yield self.at(model, problem.element, problem.message, attribute=problem.attribute)
