"""I514 mass-vs-volume-density."""

from urdfkit.lint.rule import Findings, Model, RobotRule

MIN_DENSITY, MAX_DENSITY = 1.0, 25000.0
"""[kg/m³] Range of plausible densities."""

PLACEHOLDER = 0.01
"""[kg] Masses up to this value are placeholders."""

PLACEHOLDER_SIZE = 0.004
"""[m] Shapes up to this diagonal are placeholders: exporters write spheres of one millimetre."""

SCENERY_SIZE = 20.0
"""[m] Larger shapes are grounds and buildings, whose mass is a placeholder."""


class MassVsVolume(RobotRule):
    """The density of a link is implausible.

    ## What it does
    Divides the mass by the volume of the link's shapes. Reports a density below 1 kg/m³ (air) for the smaller of the
    visual and collision volumes, and a density above 25000 kg/m³ (the heaviest metals reach 22600 kg/m³) for the larger
    volume. Three kinds of links are not checked: links of at most 10 g, because their mass is usually a placeholder;
    links with meshes; and light shapes of more than 20 m, such as a ground plane.

    ## Why is this bad?
    Usually the mass was written in grams instead of kilograms, or the size in millimetres instead of metres.

    ## Example
    ```diff
     <robot name="cart">
       <link name="chassis">
         <inertial>
    -      <mass value="2500"/>
    -      <inertia ixx="10.417" ixy="0" ixz="0" iyy="20.833" iyz="0" izz="27.083"/>
    +      <mass value="2.5"/>
    +      <inertia ixx="0.010417" ixy="0" ixz="0" iyy="0.020833" iyz="0" izz="0.027083"/>
         </inertial>
         <visual><geometry><box size="0.3 0.2 0.1"/></geometry></visual>
       </link>
     </robot>
    ```
    """

    code = "I514"
    name = "mass-vs-volume-density"
    severity = "warning"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link with an implausible density."""
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass <= PLACEHOLDER:
                continue
            extent = model.extents.get(link.name)
            if extent is None or not extent.volumes or min(extent.volumes) <= 0.0:
                continue
            if extent.diagonal <= PLACEHOLDER_SIZE:
                continue
            lightest, heaviest = mass / max(extent.volumes), mass / min(extent.volumes)
            if heaviest < MIN_DENSITY and extent.diagonal > SCENERY_SIZE:
                continue
            if heaviest < MIN_DENSITY or lightest > MAX_DENSITY:
                density = heaviest if heaviest < MIN_DENSITY else lightest
                litres = mass / density * 1000.0
                place = link.inertial.element.find("mass") or link.inertial.element
                message = f"link `{link.name}` has a density of {density:.3g} kg/m³: {mass:g} kg in {litres:.3g} litres"
                help = "check that the mass is in kg and the sizes are in m"
                yield self.at(model, place, message, attribute="value", link=link.name, help=help)
