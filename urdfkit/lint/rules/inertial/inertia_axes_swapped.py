"""I519 inertia-axes-swapped."""

from itertools import permutations

from urdfkit.lint.facts.inertia.inertia_from_shapes import computed, tensor_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_ALIKE = 0.1
"""Largest relative difference of moments that agree."""

_UNLIKE = 0.25
"""Smallest relative difference of moments that contradict each other."""


class InertiaAxesSwapped(RobotRule):
    """The moments of inertia of a link belong to other axes than its shapes.

    ## What it does
    Compares ixx, iyy and izz of each link with the moments of its shapes with uniform density. Reports the tensor if
    it differs from them, but agrees to 10 % in another order of the axes. A common factor is ignored. Meshes count as
    their bounding boxes.

    ## Why is this bad?
    The link turns about its axes with the inertia of other axes. Often a cylinder was turned, as that of a wheel,
    but the tensor is that of a cylinder along z.

    ## Example
    ```xml
    <robot name="cart">
      <link name="wheel">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.00263" ixy="0" ixz="0" iyy="0.00263" iyz="0" izz="0.005"/>
        </inertial>
        <collision>
          <origin rpy="1.5707963267948966 0 0"/>
          <geometry><cylinder radius="0.1" length="0.04"/></geometry>
        </collision>
      </link>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="cart">
      <link name="wheel">
        <inertial>
          <mass value="1"/>
          <inertia ixx="0.00263" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.00263"/>
        </inertial>
        <collision>
          <origin rpy="1.5707963267948966 0 0"/>
          <geometry><cylinder radius="0.1" length="0.04"/></geometry>
        </collision>
      </link>
    </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the tensor of the shapes, but their orientation may be wrong.
    """

    code = "I519"
    name = "inertia-axes-swapped"
    severity = "warning"
    fix = "unsafe"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each tensor with the moments of the shapes in another order."""
        for link in model.robot.links:
            inertial, extent = link.inertial, model.extents.get(link.name)
            if inertial is None or inertial.inertia is None or not inertial.mass or extent is None:
                continue
            inertia = inertial.inertia
            actual = (inertia.ixx, inertia.iyy, inertia.izz)
            tensor = tensor_of(link, extent, inertial.mass) if min(actual) > 0.0 else None
            if tensor is None or min(tensor[0], tensor[3], tensor[5]) <= 0.0:
                continue
            expected = (tensor[0], tensor[3], tensor[5])
            products = max(
                abs(each) for each in (tensor[1], tensor[2], tensor[4], inertia.ixy, inertia.ixz, inertia.iyz)
            )
            if products > _ALIKE * min(*actual, *expected) or _difference(actual, expected) < _UNLIKE:
                continue
            if min(_difference(actual, order) for order in permutations(expected)) > _ALIKE:
                continue
            element = inertial.element.find("inertia") or inertial.element
            shown = " ".join(f"{value:.3g}" for value in expected)
            yield self.at(
                model,
                element,
                f"ixx, iyy and izz of link `{link.name}` are those of its shapes in another order",
                link=link.name,
                help=f"the moments of its shapes are {shown} kg·m²; check the rpy of its shapes and of <inertial>",
                fix=computed(model, link, element),
            )


def _difference(first: tuple[float, ...], second: tuple[float, ...]) -> float:
    """Return the largest relative difference of moments that are scaled to the same sum."""
    scale = sum(first) / sum(second)
    return max(abs(a - scale * b) / max(a, scale * b) for a, b in zip(first, second, strict=True))
