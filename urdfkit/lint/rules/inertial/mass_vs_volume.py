"""I514 mass-vs-volume-density."""

from __future__ import annotations

from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

LIGHT, HEAVY = 1.0, 25000.0
"""[kg/m³]"""

LEAST = 0.01
"""[kg]"""


class MassVsVolume(RobotRule):
    """The density of a link is that of no material.

    ## What it does
    Divides the mass by the volume of the link's shapes: less than 1 kg/m³ (air) by the smaller of visual and
    collision volume, or more than 25000 kg/m³ (the heaviest metals have 22600) by the larger one. Masses under ten
    grams stand for "none", and links with meshes are left alone.

    ## Why is this bad?
    Grams were written for kilograms, or millimetres for metres.

    ## Example
    ```xml
    <robot name="cart">
      <link name="chassis">
        <inertial>
          <mass value="2500"/>
          <inertia ixx="10.417" ixy="0" ixz="0" iyy="20.833" iyz="0" izz="27.083"/>
        </inertial>
        <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="chassis">
        <inertial>
          <mass value="2.5"/>
          <inertia ixx="0.010417" ixy="0" ixz="0" iyy="0.020833" iyz="0" izz="0.027083"/>
        </inertial>
        <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
      </link>
    </robot>
    ```
    """

    code = "I514"
    name = "mass-vs-volume-density"
    severity = "warning"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each mass that no material of that volume has."""
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass <= LEAST:
                continue
            extent = model.extents.get(link.name)
            if extent is None or not extent.volumes or min(extent.volumes) <= 0.0:
                continue
            lightest, heaviest = mass / max(extent.volumes), mass / min(extent.volumes)
            if heaviest < LIGHT or lightest > HEAVY:
                density = heaviest if heaviest < LIGHT else lightest
                yield self.at(
                    model,
                    link.inertial.element.find("mass") or link.inertial.element,
                    f"link `{link.name}`: {mass:g} kg in {mass / density * 1000:.3g} litres are {density:.3g} kg/m³",
                    attribute="value",
                    link=link.name,
                    help="is the mass in kg, and are the sizes in m?",
                )
