"""I502 inertia-not-positive-definite."""

from math import inf

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.principal_moments import principal_moments, reordered
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

TOLERANCE = 1e-9
"""Tolerance relative to the largest principal moment; rounding errors are about 1e-15."""


class InertiaNotPositiveDefinite(RobotRule):
    """An inertia tensor has a principal moment that is zero or negative.

    ## What it does
    Computes the principal moments (eigenvalues) of the inertia tensor of every link. Tensors of zeros are reported by
    I504. The tensor of a thin rod is reported as a warning, because only MuJoCo rejects it. The tensor of a link on a
    fixed joint is reported as a warning, because readers merge the link with its parent. A link that is fixed to a body
    with more than twenty times its mass and inertia is reported as a note.

    ## Why is this bad?
    A body with mass and size has a positive moment of inertia about every axis. check_urdf and Pinocchio accept the
    tensor and the simulation diverges; MuJoCo and Gazebo reject it.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0.01" ixy="0.05" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
    +      <inertia ixx="0.01" ixy="0.0005" ixz="0" iyy="0.01" iyz="0" izz="0.01"/>
         </inertial>
       </link>
     </robot>
    ```
    """

    code = "I502"
    name = "inertia-not-positive-definite"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor that is not positive definite."""
        bodies = AttachedBodies(model.robot)
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if mass is not None and mass < 0.0:
                continue
            for moments, element in principal_moments(link):
                largest = max(abs(moments[0]), abs(moments[2]))
                if largest == 0.0 or moments[0] > TOLERANCE * largest or reordered(element) is not None:
                    continue
                listed = ", ".join(f"{moment:.3g}" for moment in moments)
                sign = "negative" if moments[0] < -TOLERANCE * largest else "zero"
                count = sum(moment <= TOLERANCE * largest for moment in moments) if largest < inf else 1
                which = ("one of its principal moments", "two of its principal moments", "all its principal moments")[
                    count - 1
                ]
                is_rod = sign == "zero" and moments[1] > (1.0 - TOLERANCE) * moments[2]
                severity: Severity | None = (
                    "warning" if is_rod or bodies.is_fixed(link) or bodies.is_small(link) else None
                )
                severity = "note" if bodies.is_negligible(link) else severity
                verb = "is" if count == 1 else "are"
                message = f"inertia of link `{link.name}` is impossible: {which} ({listed} kg·m²) {verb} {sign}"
                help = "compute it from shape and mass; products of inertia are small compared with the diagonal"
                yield self.at(model, element, message, link=link.name, help=help, severity=severity, kind=sign)
