"""I507 inertia-vs-geometry-too-large."""

from math import sqrt

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.principal_moments import is_identity, principal_moments
from urdfkit.description.urdf.robot import Link
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.inertia.inertia_from_shapes import computed, place_and_help
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

MARGIN = 1.2
"""Largest plausible ratio; simplified shapes may be slightly smaller than the body."""

MARGIN_WITHOUT_VISUALS = 3.0
"""Largest plausible ratio for links without visuals, whose collision shapes often cover only a part of the body."""


class InertiaTooLarge(RobotRule):
    """The inertia of a link is larger than its shapes allow.

    ## What it does
    Compares the radius of gyration √(I/m) with the distance from the centre of mass to the farthest point of all visual
    and collision shapes of the link. Collision shapes often cover only a part of the body. Therefore, a link without
    visual shapes is reported only if the radius exceeds three times the distance. Links with an unreadable mesh are not
    checked. The finding is a note if a fixed joint attaches the link to a body with more than twenty times its mass and
    inertia.

    ## Why is this bad?
    However the mass is distributed inside the shapes, √(I/m) cannot exceed that distance. The link rotates as if it
    were much larger: wheels hardly accelerate and arms swing like flywheels. Often the tensor was copied from another
    link, or is in g·mm².

    ## Example
    ```diff
     <robot name="cart">
       <link name="wheel">
         <inertial>
           <mass value="0.2"/>
    -      <inertia ixx="0.4" ixy="0" ixz="0" iyy="0.4" iyz="0" izz="0.5"/>
    +      <inertia ixx="0.004667" ixy="0" ixz="0" iyy="0.004667" iyz="0" izz="0.009"/>
         </inertial>
         <visual><geometry><cylinder radius="0.3" length="0.1"/></geometry></visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix computes the tensor of the link's shapes at uniform density, but the real mass distribution may
    differ.
    """

    code = "I507"
    name = "inertia-vs-geometry-too-large"
    severity = "warning"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor that is too large for the shapes."""
        plausible: list[Element] = []
        implausible: list[tuple[Link, Element, str]] = []
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass <= 0.0:
                continue
            extent = model.extents.get(link.name)
            if extent is None:
                continue
            reach = extent.radius(link.inertial.origin.xyz)
            margin = MARGIN if link.visuals else MARGIN_WITHOUT_VISUALS
            for moments, element in principal_moments(link):
                gyration = sqrt(max(moments[2], 0.0) / mass)
                if reach > 0.0 and gyration > margin * reach and not is_identity(element):
                    from urdfkit.lint.facts.inertia.inertia_formulas import has_slip

                    if has_slip(model, element):
                        continue  # Reported by X119.
                    message = (
                        f"inertia of link `{link.name}` is too large: radius of gyration {gyration:.3g} m, "
                        f"but its shapes extend only {reach:.3g} m from the centre of mass"
                    )
                    implausible.append((link, element, message))
                else:
                    plausible.append(element)
        bodies = AttachedBodies(model.robot)
        for link, element, message in implausible:
            place, help = place_and_help(element, plausible)
            fix = computed(model, link, element)
            severity: Severity | None = "note" if bodies.is_negligible(link) else None
            yield self.at(model, place, message, link=link.name, help=help, fix=fix, severity=severity)
