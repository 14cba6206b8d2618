"""I501 mass-nonpositive."""

from __future__ import annotations

from urdfkit.description.masses import massless
from urdfkit.lint.gazebo import is_simulated
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model


class MassNonpositive(RobotRule):
    """A link that moves has no mass, or a link has a negative one.

    ## What it does
    Looks for ``<mass>`` below zero, and for a mass of zero where a link is moved by a joint and no link fixed to it
    has one, or where a link with shapes that is fixed to no other has an inertia beside it. Zero is a warning
    for robots that are not simulated.

    ## Why is this bad?
    Simulators divide by the mass. check_urdf accepts it, Gazebo drops the link, MuJoCo refuses the model.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <inertial>
          <mass value="-1"/>
          <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
      </link>
    </robot>
    ```
    """

    code = "I501"
    name = "mass-nonpositive"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each mass that cannot be."""
        moved: dict[str, str] | None = None
        fixed = {joint.child for joint in model.robot.joints if joint.type == "fixed"}
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass > 0.0:
                continue
            element = link.inertial.element.find("mass") or link.inertial.element
            if mass < 0.0:
                yield self.at(model, element, f"mass of link `{link.name}` is negative: {mass:g} kg", link=link.name)
                continue
            tensor = link.inertial.inertia
            is_turned = tensor is not None and min(tensor.ixx, tensor.iyy, tensor.izz) > 0.0
            if is_turned and (link.visuals or link.collisions) and link.name not in fixed:
                yield self.at(
                    model,
                    element,
                    f"link `{link.name}` has an inertia and no mass",
                    attribute="value",
                    link=link.name,
                    severity=None if is_simulated(model) else "warning",
                )
                continue
            if moved is None:
                bodies = massless(model.robot, floating=False)
                moved = {body.name: joint.name for body, joint in bodies if joint is not None}
            if link.name in moved:
                yield self.at(
                    model,
                    element,
                    f"link `{link.name}` is moved by joint `{moved[link.name]}` and has no mass",
                    attribute="value",
                    link=link.name,
                    severity=None if is_simulated(model) else "warning",
                )
