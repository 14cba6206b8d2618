"""Z824 gazebo-material-unknown."""

from __future__ import annotations

from urdfkit.lint.edits import new_text
from urdfkit.lint.rule import NOT_GAZEBO, RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class GazeboMaterialUnknown(RobotRule):
    """Gazebo has no material of that name.

    ## What it does
    Compares ``<material>Gazebo/…</material>`` with the materials that come with Gazebo classic. Names without that
    prefix pass: they may come with the robot.

    ## Why is this bad?
    "Unable to find material": the link is white.

    ## Example
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <material>Gazebo/Oragne</material>
      </gazebo>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="base"/>
      <gazebo reference="base">
        <material>Gazebo/Orange</material>
      </gazebo>
    </robot>
    ```

    ## Fix safety
    Unsafe: the nearest name is taken.
    """

    code = "Z824"
    name = "gazebo-material-unknown"
    severity = "warning"
    fix = "unsafe"
    not_for = NOT_GAZEBO | {"gz"}

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each name that is none of Gazebo's."""
        from urdfkit.description.gazebo_materials import unknown_materials

        for element, name, meant in unknown_materials(model.robot):
            if not model.is_unresolved(element):
                yield self.at(
                    model,
                    element,
                    f"Gazebo has no material `{name}`",
                    help=f"did you mean `{meant}`?" if meant else None,
                    fix=new_text(model, element, meant, "unsafe", f"Write `{meant}`") if meant else None,
                )
