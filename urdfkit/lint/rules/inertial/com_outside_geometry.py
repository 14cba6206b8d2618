"""I513 com-outside-geometry."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

FRACTION = 0.1
"""Of the diagonal of the box around the shapes: simplified shapes leave parts out."""

LEAST = 0.005
"""[m]"""

UNSEEN = 1.0
"""Of that diagonal, where a link is seen nowhere: collision shapes alone often cover a part of the body."""

LIGHT = 0.01
"""[kg]: less stands for "none" where a link is seen nowhere."""


class ComOutsideGeometry(RobotRule):
    """The centre of mass of a link is outside of its shapes.

    ## What it does
    Compares the ``<origin>`` of the ``<inertial>`` with the box around all shapes of the link, visual and
    collision. Collision shapes alone, of a link that is seen nowhere, often cover a part of the body: there it has to
    be farther out than the box is long. Links with a mesh that cannot be read are left alone.

    ## Why is this bad?
    The robot tips over, or swings, as if its weight hung beside it. Mostly the origin of the shape was not copied
    to the inertial.

    ## Example
    ```xml
    <robot name="cart">
      <link name="chassis">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
        <visual>
          <origin xyz="0 0 0.15"/>
          <geometry><box size="0.3 0.2 0.1"/></geometry>
        </visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="chassis">
        <inertial>
          <origin xyz="0 0 0.15"/>
          <mass value="1"/>
          <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
        </inertial>
        <visual>
          <origin xyz="0 0 0.15"/>
          <geometry><box size="0.3 0.2 0.1"/></geometry>
        </visual>
      </link>
    </robot>
    ```
    """

    code = "I513"
    name = "com-outside-geometry"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each centre of mass that is clearly outside."""
        for link in model.robot.links:
            inertial = link.inertial
            if inertial is None or not inertial.mass or inertial.mass < 0.0:
                continue
            extent = model.extents.get(link.name)
            if extent is None:
                continue
            if not link.visuals and inertial.mass < LIGHT:
                continue
            away = extent.outside(inertial.origin.xyz)
            if away > max((FRACTION if link.visuals else UNSEEN) * extent.diagonal, LEAST):
                origin = inertial.element.find("origin")
                yield self.at(
                    model,
                    origin or inertial.element,
                    f"the centre of mass of link `{link.name}` is {away:.3g} m outside of its shapes",
                    attribute="xyz" if origin is not None else None,
                    link=link.name,
                    help=None if any(inertial.origin.xyz) else "give <inertial> the <origin> that the shape has",
                )
