"""I509 inertia-identity-placeholder."""

from math import sqrt

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.principal_moments import is_identity
from urdfkit.lint.facts.gazebo.plugins import is_simulated
from urdfkit.lint.facts.inertia.inertia_from_shapes import computed, tensor_of
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

MIN_MOMENT, MAX_MOMENT = 0.1, 25.0
"""[kg·m²] Range of the largest moment at uniform density for which an identity tensor is plausible."""


class InertiaIdentity(RobotRule):
    """The inertia tensor of a link is the identity matrix, which is usually a placeholder.

    ## What it does
    Checks for ixx = iyy = izz = 1 with zero products of inertia. The tensor is accepted if the link's shapes are large
    enough for it and their largest moment at uniform density is between 0.1 and 25 kg·m². It is also accepted if fixed
    joints attach the link to a link ``world``. The finding is a note for the root link of a robot that is not
    simulated, because such a link often stands still.

    ## Why is this bad?
    1 kg·m² is the inertia of a refrigerator. Wheels and fingers with this inertia hardly accelerate.

    ## Example
    ```diff
     <robot name="arm">
       <link name="arm">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
    +      <inertia ixx="0.001667" ixy="0" ixz="0" iyy="0.014167" iyz="0" izz="0.014167"/>
         </inertial>
         <visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual>
       </link>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix computes the tensor of the link's shapes at uniform density, but the real mass distribution may
    differ.
    """

    code = "I509"
    name = "inertia-identity-placeholder"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each identity that the shapes do not explain."""
        bodies = AttachedBodies(model.robot)
        roots = {link.name for link in model.robot.roots()} if len(model.robot.links) > 1 else set()
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or not mass or mass < 0.0:
                continue
            for element in link.inertial.element.find_all("inertia"):
                if not is_identity(element):
                    continue
                extent = model.extents.get(link.name)
                if extent is not None and sqrt(1.0 / mass) < extent.radius(link.inertial.origin.xyz):
                    values = tensor_of(link, extent, mass)
                    if values is None or MIN_MOMENT <= max(values) <= MAX_MOMENT:
                        continue
                if extent is None and not link.visuals and not link.collisions:
                    continue  # The size of the link is unknown.
                if bodies.is_fixed_to_world(link):
                    continue
                message = f"inertia of link `{link.name}` is the identity matrix, a placeholder"
                help = "compute it from shape and mass"
                fix = computed(model, link, element)
                severity: Severity | None = "note" if link.name in roots and not is_simulated(model) else None
                yield self.at(model, element, message, link=link.name, help=help, fix=fix, severity=severity)
