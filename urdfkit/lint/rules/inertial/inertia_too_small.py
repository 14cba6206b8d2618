"""I508 inertia-vs-geometry-too-small."""

from math import sqrt

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.principal_moments import principal_moments
from urdfkit.description.urdf.robot import Link, Mesh
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.inertia.inertia_from_shapes import computed, place_and_help
from urdfkit.lint.finding import Severity
from urdfkit.lint.model.placement import shapes_of, solid
from urdfkit.lint.rule import Findings, Model, RobotRule

MIN_RATIO = 0.05
"""Smallest plausible ratio; a solid ball has 0.63, a rod 0.58, and links with a motor at one end have less."""

MIN_MASS = 0.01
"""[kg] Smaller masses of links without visuals are placeholders."""

MAX_REACH = 25.0
"""[m] Links with a mesh that extend farther have an incorrect mesh scale, which G604 reports."""


class InertiaTooSmall(RobotRule):
    """The inertia of a link is much smaller than its shapes suggest.

    ## What it does
    Compares the radius of gyration √(I/m) with the distance from the centre of mass to the farthest point of the link's
    shapes. Reports a radius below a twentieth of that distance, because nearly all the mass would then be concentrated
    in one point. A link that is fixed to a body with more than twenty times its mass and inertia is reported as a note.

    ## Why is this bad?
    Light parts on strong joints make simulations jitter, and the integrator needs tiny steps.

    ## Example
    ```diff
     <robot name="arm">
       <link name="arm">
         <inertial>
           <mass value="2"/>
    -      <inertia ixx="0.000001" ixy="0" ixz="0" iyy="0.000001" iyz="0" izz="0.000001"/>
    +      <inertia ixx="0.003333" ixy="0" ixz="0" iyy="0.028333" iyz="0" izz="0.028333"/>
         </inertial>
         <visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix computes the tensor of the link's shapes at uniform density, but the real mass distribution may
    differ.
    """

    code = "I508"
    name = "inertia-vs-geometry-too-small"
    severity = "warning"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor that is too small for the shapes."""
        plausible: list[Element] = []
        implausible: list[tuple[Link, Element, str]] = []
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass <= 0.0:
                continue
            extent, has_visuals = solid(link, model.extents)
            if extent is None or extent.outside(link.inertial.origin.xyz) > 0.0:
                continue  # Reported by I513.
            if not has_visuals and mass < MIN_MASS:
                continue
            reach = extent.radius(link.inertial.origin.xyz)
            if reach > MAX_REACH and any(isinstance(shape.geometry, Mesh) for shape in shapes_of(link)):
                continue  # Reported by G604.
            for moments, element in principal_moments(link):
                gyration = sqrt(max(moments[2], 0.0) / mass)
                if 0.0 < gyration < MIN_RATIO * reach and not _has_detached_shape(model, link):
                    message = (
                        f"inertia of link `{link.name}` is too small: radius of gyration {gyration:.3g} m, "
                        f"but its shapes extend {reach:.3g} m from the centre of mass"
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


def _has_detached_shape(model: Model, link: Link) -> bool:
    """Whether a detached shape explains the ratio."""
    from urdfkit.lint.facts.detached_shapes import detached_shapes

    return bool(detached_shapes(model, link)[0])
