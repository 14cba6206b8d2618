"""I513 com-outside-geometry."""

from urdfkit.lint.rule import Findings, Model, RobotRule

TOLERANCE = 0.1
"""Tolerance relative to the diagonal of the bounding box; simplified shapes omit parts of the body."""

MIN_TOLERANCE = 0.005
"""[m] Smallest tolerance."""

TOLERANCE_WITHOUT_VISUALS = 1.0
"""Tolerance for links without visuals, whose collision shapes often cover only a part of the body."""

MIN_MASS = 0.01
"""[kg] Smaller masses of links without visuals are placeholders."""


class ComOutsideGeometry(RobotRule):
    """The centre of mass of a link is outside its shapes.

    ## What it does
    Compares the ``<origin>`` of ``<inertial>`` with the bounding box of all visual and collision shapes of the link.
    Collision shapes alone often cover only a part of the body, so for links without visuals only a distance of more
    than the diagonal of the box is reported. Links with an unreadable mesh are not checked.

    ## Why is this bad?
    The robot tips over, or swings as if its mass hung next to it. The usual cause is an origin of the shape that was
    not copied to ``<inertial>``.

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
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each centre of mass outside the shapes."""
        for link in model.robot.links:
            inertial = link.inertial
            if inertial is None or not inertial.mass or inertial.mass < 0.0:
                continue
            extent = model.extents.get(link.name)
            if extent is None:
                continue
            if not link.visuals and inertial.mass < MIN_MASS:
                continue
            distance = extent.outside(inertial.origin.xyz)
            if distance > max(
                (TOLERANCE if link.visuals else TOLERANCE_WITHOUT_VISUALS) * extent.diagonal, MIN_TOLERANCE
            ):
                origin = inertial.element.find("origin")
                yield self.at(
                    model,
                    origin or inertial.element,
                    f"centre of mass of link `{link.name}` is {distance:.3g} m outside its shapes",
                    attribute="xyz" if origin is not None else None,
                    link=link.name,
                    help="correct the <origin> of <inertial>"
                    if any(inertial.origin.xyz)
                    else "copy the <origin> of the shape to <inertial>",
                )
