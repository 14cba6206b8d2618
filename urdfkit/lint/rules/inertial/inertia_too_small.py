"""I508 inertia-vs-geometry-too-small."""

from __future__ import annotations

from math import sqrt

from urdfkit.description.robot import Mesh
from urdfkit.lint.placement import shapes_of
from urdfkit.lint.principal import principal_moments
from urdfkit.lint.rule import RobotRule
from urdfkit.lint.tensor import computed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.description.robot import Link
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

SMALL = 0.05
"""A solid ball has 0.63, a rod 0.58 of its reach; motors at one end bring it down, but not so far."""

LEAST = 0.01
"""[kg]: less stands for "none" where a link is seen nowhere."""

MILLIMETRES = 25.0
"""[m]: meshes that reach farther are in millimetres, and not the inertia is to blame."""


class InertiaTooSmall(RobotRule):
    """The inertia of a link is much smaller than its shapes suggest.

    ## What it does
    Compares the radius of gyration √(I/m) with the distance from the centre of mass to the farthest point of the
    link's shapes: less than a twentieth of it would put nearly all the mass into one point.

    ## Why is this bad?
    Light parts with strong joints make simulations jitter, and the integrator needs tiny steps.

    ## Example
    ```xml
    <robot name="arm">
      <link name="arm">
        <inertial>
          <mass value="2"/>
          <inertia ixx="0.000001" ixy="0" ixz="0" iyy="0.000001" iyz="0" izz="0.000001"/>
        </inertial>
        <visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="arm">
        <inertial>
          <mass value="2"/>
          <inertia ixx="0.003333" ixy="0" ixz="0" iyy="0.028333" iyz="0" izz="0.028333"/>
        </inertial>
        <visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the tensor is computed for the link's shapes, filled evenly.
    """

    code = "I508"
    name = "inertia-vs-geometry-too-small"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each tensor that is too small for the shapes."""
        right: list[Element] = []
        wrong: list[tuple[Link, Element, str]] = []
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass <= 0.0:
                continue
            extent = model.extents.get(link.name)
            if extent is None or extent.outside(link.inertial.origin.xyz) > 0.0:
                continue  # Where the centre of mass is outside, that is what is wrong.
            if not link.visuals and mass < LEAST:
                continue
            reach = extent.radius(link.inertial.origin.xyz)
            if reach > MILLIMETRES and any(isinstance(shape.geometry, Mesh) for shape in shapes_of(link)):
                continue  # It is the scale of the mesh that is wrong.
            for moments, element in principal_moments(link):
                gyration = sqrt(max(moments[2], 0.0) / mass)
                if 0.0 < gyration < SMALL * reach and not _is_apart(model, link):
                    message = (
                        f"inertia of link `{link.name}` is very small: radius of gyration {gyration:.3g} m, "
                        f"its shapes reach {reach:.3g} m from the centre of mass"
                    )
                    wrong.append((link, element, message))
                else:
                    right.append(element)
        for link, element, message in wrong:
            from urdfkit.lint.blamed import call_of

            call = call_of(element, right) if element.origin.expansions else None
            help = "compute it from shape and mass"
            if call is not None:
                help = "other calls of the macro are right: look at the arguments of this one"
            fix = computed(model, link, element)
            yield self.at(model, call or element, message, link=link.name, help=help, fix=fix)


def _is_apart(model: Model, link: Link) -> bool:
    """Whether one of the shapes is to blame, not the inertia."""
    from urdfkit.lint.apart import apart

    return bool(apart(model, link)[0])
