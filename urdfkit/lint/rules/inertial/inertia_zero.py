"""I504 inertia-zero."""

from urdfkit.description.urdf.massless_links import is_free, massless
from urdfkit.lint.facts.inertia.inertia_from_shapes import COMPONENTS, computed
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule


class InertiaZero(RobotRule):
    """A link has a mass but zero inertia.

    ## What it does
    Checks for tensors of zeros on links with a mass. The finding is an error if a joint moves the link. It is a note if
    the link is fixed to others, because the link then represents a point mass.

    ## Why is this bad?
    Nothing resists the rotation of the link: simulators divide by zero, and MuJoCo rejects the model.

    ## Example
    ```diff
     <robot name="arm">
       <link name="world"/>
       <link name="arm">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>
    +      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.002"/>
         </inertial>
       </link>
       <joint name="elbow" type="continuous">
         <parent link="world"/>
         <child link="arm"/>
         <axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix computes the tensor of the link's shapes at uniform density, but the real mass distribution may
    differ.
    """

    code = "I504"
    name = "inertia-zero"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor of zeros."""
        moving: set[str] | None = None
        for link in model.robot.links:
            inertial = link.inertial
            inertia = inertial.inertia if inertial is not None else None
            if inertial is None or inertia is None or (inertial.mass or 0.0) <= 0.0:
                continue
            if any(getattr(inertia, name) for name in COMPONENTS):
                continue
            if moving is None:
                moving = {body.name for body, _ in massless(model.robot, floating=is_free(model.robot))}
            message = f"link `{link.name}` has a mass of {inertial.mass:g} kg but zero inertia"
            help = "compute the inertia from shape and mass"
            fix = computed(model, link, inertia.element)
            severity: Severity | None = None if link.name in moving else "note"
            yield self.at(model, inertia.element, message, link=link.name, help=help, fix=fix, severity=severity)
