"""I503 inertia-triangle-inequality."""

from urdfkit.description.urdf.attached_bodies import AttachedBodies
from urdfkit.description.urdf.principal_moments import principal_moments, reordered, shown
from urdfkit.lint.finding import Severity
from urdfkit.lint.rule import Findings, Model, RobotRule

TOLERANCE = 1e-3
"""Violations up to this fraction of the largest moment result from rounded numbers and are no errors."""

SLIP = 1e-4
"""Violations up to this fraction are notes, here and in the repairs of a simulation."""

NOISE = 1e-9
"""Violations up to this fraction are not reported: the principal moments are computed."""


class InertiaTriangleInequality(RobotRule):
    """The principal moments of an inertia tensor violate the triangle inequality.

    ## What it does
    Computes the principal moments A ≤ B ≤ C of every tensor and checks that A + B ≥ C. Rounded numbers cause small
    violations: up to 0.0001 C they are reported as notes, and up to 0.001 C they are reported as warnings. The tensor
    of a link on a fixed joint is reported as a warning, because readers merge the link with its parent. A link that is
    fixed to a body with more than twenty times its mass and inertia is reported as a note.

    ## Why is this bad?
    Every physical body satisfies the inequality: A + B - C is twice the second moment of mass along the third axis
    (Wittenburg, Dynamics of Multibody Systems, 3.1). A tensor that violates it can be positive definite and pass most
    parsers, but then joints shake and wheels hop. MuJoCo rejects it.

    ## Example
    ```diff
     <robot name="cart">
       <link name="chassis">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0.4" ixy="0.1" ixz="0.1" iyy="0.4" iyz="0.1" izz="0.2"/>
    +      <inertia ixx="0.4" ixy="0" ixz="0" iyy="0.4" iyz="0" izz="0.2"/>
         </inertial>
       </link>
     </robot>
    ```
    """

    code = "I503"
    name = "inertia-triangle-inequality"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor that violates the inequality."""
        bodies = AttachedBodies(model.robot)
        for link in model.robot.links:
            for moments, element in principal_moments(link):
                small, middle, large = moments
                if small <= 0.0 or small + middle >= large * (1.0 - NOISE):
                    continue
                from urdfkit.lint.facts.inertia.inertia_formulas import has_slip

                if reordered(element) is not None or has_slip(model, element):
                    continue  # Reported by I505 or X119.
                a, b, c = shown(moments)
                excess = (large - small - middle) / large
                is_note = excess <= SLIP or bodies.is_negligible(link)
                is_warning = excess <= TOLERANCE or bodies.is_fixed(link) or bodies.is_small(link)
                message = f"inertia of link `{link.name}` is impossible: principal moments {a}, {b}, {c} kg·m²: "
                message += f"{a} + {b} < {c}"
                help = "compute it from shape and mass; set placeholders for products of inertia to 0"
                severity: Severity | None = "note" if is_note else "warning" if is_warning else "error"
                yield self.at(model, element, message, link=link.name, help=help, severity=severity)
