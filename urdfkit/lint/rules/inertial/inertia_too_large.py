"""I507 inertia-vs-geometry-too-large."""

from __future__ import annotations

from math import sqrt

from urdfkit.lint.principal import is_identity, principal_moments
from urdfkit.lint.rule import RobotRule
from urdfkit.lint.tensor import computed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.element import Element
    from urdfkit.description.robot import Link
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

MARGIN = 1.2
"""Simplified shapes may be a little smaller than the body."""

UNSEEN = 3.0
"""Collision shapes alone, of a link that is seen nowhere, often cover a part of the body."""


class InertiaTooLarge(RobotRule):
    """The inertia of a link is larger than its shapes allow.

    ## What it does
    Compares the radius of gyration √(I/m) with the distance from the centre of mass to the farthest point of all
    the link's shapes, visual and collision. Collision shapes alone, of a link that is seen nowhere, often cover a
    part of the body: there it has to be three times as large. Links with a mesh that cannot be read are left alone.

    ## Why is this bad?
    However the mass is spread inside the shapes, √(I/m) cannot exceed that distance. The link turns as if it were
    much larger: wheels do not speed up, arms swing like flywheels. Often the tensor was copied, or is in g·mm².

    ## Example
    ```xml
    <robot name="cart">
      <link name="wheel">
        <inertial>
          <mass value="0.2"/>
          <inertia ixx="0.4" ixy="0" ixz="0" iyy="0.4" iyz="0" izz="0.5"/>
        </inertial>
        <visual><geometry><cylinder radius="0.3" length="0.1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="wheel">
        <inertial>
          <mass value="0.2"/>
          <inertia ixx="0.004667" ixy="0" ixz="0" iyy="0.004667" iyz="0" izz="0.009"/>
        </inertial>
        <visual><geometry><cylinder radius="0.3" length="0.1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the tensor is computed for the link's shapes, filled evenly.
    """

    code = "I507"
    name = "inertia-vs-geometry-too-large"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each tensor that is too large for the shapes."""
        right: list[Element] = []
        wrong: list[tuple[Link, Element, str]] = []
        for link in model.robot.links:
            mass = link.inertial.mass if link.inertial is not None else None
            if link.inertial is None or mass is None or mass <= 0.0:
                continue
            extent = model.extents.get(link.name)
            if extent is None:
                continue
            reach = extent.radius(link.inertial.origin.xyz)
            margin = MARGIN if link.visuals else UNSEEN
            for moments, element in principal_moments(link):
                gyration = sqrt(max(moments[2], 0.0) / mass)
                if gyration > margin * reach and not is_identity(element):
                    from urdfkit.lint.algebra import has_slip

                    if has_slip(model, element):
                        continue  # X119 says what is wrong with it.
                    message = (
                        f"inertia of link `{link.name}` is too large: radius of gyration {gyration:.3g} m, "
                        f"but its shapes reach {reach:.3g} m from the centre of mass"
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
