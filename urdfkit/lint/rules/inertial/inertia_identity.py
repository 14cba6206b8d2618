"""I509 inertia-identity-placeholder."""

from __future__ import annotations

from math import sqrt

from urdfkit.lint.principal import is_identity
from urdfkit.lint.rule import RobotRule
from urdfkit.lint.tensor import computed, tensor_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

LEAST, MOST = 0.1, 25.0
"""[kg·m²]: what the largest moment of the link's shapes, filled evenly, may be for an identity to be meant."""


class InertiaIdentity(RobotRule):
    """The inertia of a link is the identity, which stands for "not computed yet".

    ## What it does
    Looks for ixx = iyy = izz = 1 without products of inertia, unless the link's shapes are large enough for it
    and, filled evenly with its mass, have a largest moment between 0.1 and 25 kg·m².

    ## Why is this bad?
    One kilogram times square metre is the inertia of a fridge. Wheels and fingers with it do not get moving.

    ## Example
    ```xml
    <robot name="arm">
      <link name="arm">
        <inertial>
          <mass value="1"/>
          <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>
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
          <mass value="1"/>
          <inertia ixx="0.001667" ixy="0" ixz="0" iyy="0.014167" iyz="0" izz="0.014167"/>
        </inertial>
        <visual><geometry><box size="0.4 0.1 0.1"/></geometry></visual>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the tensor is computed for the link's shapes, filled evenly.
    """

    code = "I509"
    name = "inertia-identity-placeholder"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each identity that the shapes do not explain."""
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
                    if values is None or LEAST <= max(values) <= MOST:
                        continue
                if extent is None and not link.visuals and not link.collisions:
                    continue  # Nothing says how large the link is.
                yield self.at(
                    model,
                    element,
                    f"inertia of link `{link.name}` is the identity: a placeholder",
                    link=link.name,
                    help="compute it from shape and mass",
                    fix=computed(model, link, element),
                )
