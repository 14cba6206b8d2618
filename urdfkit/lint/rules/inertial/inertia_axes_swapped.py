"""I519 inertia-axes-swapped."""

import re
from collections.abc import Sequence
from itertools import permutations

from urdfkit.description.urdf.robot import Cylinder, Link
from urdfkit.description.xml.element import Element
from urdfkit.description.xml.source import Expansion, Origin
from urdfkit.lint.facts.inertia.inertia_from_shapes import computed, tensor_of
from urdfkit.lint.facts.inertia.swapped_arguments import swapped_arguments
from urdfkit.lint.finding import Finding
from urdfkit.lint.rule import Findings, Model, RobotRule

_ALIKE = 0.1
"""Largest relative difference of moments that agree."""

_EQUAL = 0.02
"""Largest relative difference of moments that were computed with the same formula."""

_AXIS = r"(?i)\b([xyz])[- ]axis\b|\b(?:axis|along)\s+(?:is\s+)?(?:the\s+)?[+-]?([xyz])\b"
"""Matches the axis of a shape in a comment."""

_UNLIKE = 0.25
"""Smallest relative difference of moments that contradict each other."""


class InertiaAxesSwapped(RobotRule):
    """The moments of inertia of a link are assigned to the wrong axes.

    ## What it does
    Compares ixx, iyy and izz of each link with the moments of inertia of its shapes at uniform density. Reports a
    tensor that differs from these moments in two cases:

    - It agrees with them within 10 % if the axes are in a different order. A common factor of the three moments is
      ignored.
    - It agrees within 2 % with the moments of a cylinder with radius and length swapped.

    Meshes are replaced by their bounding boxes. Also reports macro calls in ``<inertial>`` that pass the length of a
    part as ``r`` and its radius as ``h``, such as ``r="${wheel_width}" h="${wheel_radius}"``.

    ## Why is this bad?
    The link accelerates too easily about one axis and too slowly about another. Often the cylinder of a wheel was
    rotated, but its tensor is still that of a cylinder along z.

    ## Example
    ```diff
     <robot name="cart">
       <link name="wheel">
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0.00263" ixy="0" ixz="0" iyy="0.00263" iyz="0" izz="0.005"/>
    +      <inertia ixx="0.00263" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.00263"/>
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
            found = list(self._of_shapes(model, link))
            yield from found
            element = link.inertial.element.find("inertia") if link.inertial is not None else None
            swapped = swapped_arguments(model, element) if element is not None and not found else None
            if element is not None and swapped is not None:
                yield self._of_call(model, element, *swapped)

    def _of_shapes(self, model: Model, link: Link) -> Findings:
        """Yield the finding for a tensor that is not that of the shapes of its link."""
        inertial, extent = link.inertial, model.extents.get(link.name)
        if inertial is None or inertial.inertia is None or not inertial.mass or extent is None:
            return
        inertia = inertial.inertia
        actual = (inertia.ixx, inertia.iyy, inertia.izz)
        tensor = tensor_of(link, extent, inertial.mass) if min(actual) > 0.0 else None
        if tensor is None or min(tensor[0], tensor[3], tensor[5]) <= 0.0:
            return
        expected = (tensor[0], tensor[3], tensor[5])
        products = max(abs(each) for each in (tensor[1], tensor[2], tensor[4], inertia.ixy, inertia.ixz, inertia.iyz))
        if products > _ALIKE * min(*actual, *expected) or _difference(actual, expected) < _UNLIKE:
            return
        message = f"ixx, iyy and izz of link `{link.name}` are the moments of its shapes in a different order"
        if min(_difference(actual, order) for order in permutations(expected)) > _ALIKE:
            if not _is_of_swapped_cylinder(link, inertial.mass, actual, expected):
                return
            message = f"the inertia of link `{link.name}` is that of a cylinder with radius and length swapped"
        element = inertial.element.find("inertia") or inertial.element
        shown = " ".join(f"{value:.3g}" for value in expected)
        help = f"the moments of its shapes are {shown} kg·m²; check the rpy of its shapes and of <inertial>"
        fix, origin = computed(model, link, element), inertial.element.find("origin")
        axes = _swapped(model, element, actual, expected) if fix is None else None
        kind = "swapped" if message.endswith("swapped") else "turned" if _is_turned(link) else ""
        if axes is not None:
            yield self.at(model, element, message, attribute=axes, link=link.name, help=help, kind=kind)
        elif fix is None and origin is not None and _lacks_rotation(link):
            yield self.at(model, origin, message, attribute="rpy", link=link.name, help=help)
        else:
            yield self.at(model, element, message, link=link.name, help=help, fix=fix, kind=kind)

    def _of_call(self, model: Model, element: Element, call: Expansion, radius: str, length: str) -> Finding:
        """Return the finding for a macro call that swaps radius and length."""
        chain = element.origin.expansions
        place = Origin(call.position, chain[chain.index(call) + 1 :])
        message = f"the call of macro `{call.macro}` swaps radius and length"
        return self.at(model, place, message, attribute=radius, help=f"swap the values of `{radius}` and `{length}`")


def _swapped(model: Model, element: Element, actual: Sequence[float], expected: Sequence[float]) -> str | None:
    """Return the first wrong moment, if the comment before the macro around it states the axis of the shape.

    Then the tensor is wrong, and not the rotation of its frame.
    """
    calls, tag = element.origin.expansions, model.tag(element.origin.position)
    macro = next((each for each in tag.ancestors() if each.name == "xacro:macro"), None) if tag is not None else None
    pairs = [abs(expected[1] - expected[2]), abs(expected[0] - expected[2]), abs(expected[0] - expected[1])]
    if not calls or macro is None:
        return None
    before = model.document(element.origin.position.file).source.text[: macro.start].rstrip()
    comment = before.rpartition("<!--")[2] if before.endswith("-->") else ""
    stated = {axis.lower() for pair in re.findall(_AXIS, comment) for axis in pair if axis}
    if stated != {"xyz"[pairs.index(min(pairs))]}:
        return None
    names = zip(("ixx", "iyy", "izz"), actual, expected, strict=True)
    return next((name for name, a, b in names if abs(a - b) > _ALIKE * max(a, b)), None)


def _is_turned(link: Link) -> bool:
    """Return whether a shape of a link or its inertial has a rotation, which may be the wrong one."""
    parts = (*link.visuals, *link.collisions, *([link.inertial] if link.inertial is not None else ()))
    return any(any(part.origin.rpy) for part in parts)


def _lacks_rotation(link: Link) -> bool:
    """Return whether all shapes of a link have the same rotation, and its inertial has none."""
    turns = {shape.origin.rpy for shape in link.collisions or link.visuals}
    return len(turns) == 1 and any(*turns) and link.inertial is not None and not any(link.inertial.origin.rpy)


def _is_of_swapped_cylinder(link: Link, mass: float, actual: tuple[float, ...], expected: tuple[float, ...]) -> bool:
    """Return whether moments are those of the only cylinder of a link with its radius and its length swapped."""
    shapes = [shape.geometry for shape in link.collisions or link.visuals]
    if len(shapes) != 1 or not isinstance(shapes[0], Cylinder) or not shapes[0].radius or not shapes[0].length:
        return False
    radius, length = shapes[0].length, shapes[0].radius
    along, across = mass * radius**2 / 2.0, mass * (3.0 * radius**2 + length**2) / 12.0
    pairs = [
        abs(a - b) for a, b in ((expected[1], expected[2]), (expected[0], expected[2]), (expected[0], expected[1]))
    ]
    axis = pairs.index(min(pairs))
    swapped = tuple(along if each == axis else across for each in range(3))
    return all(abs(a - b) < _EQUAL * b for a, b in zip(actual, swapped, strict=True))


def _difference(first: tuple[float, ...], second: tuple[float, ...]) -> float:
    """Return the largest relative difference of moments that are scaled to the same sum."""
    scale = sum(first) / sum(second)
    return max(abs(a - scale * b) / max(a, scale * b) for a, b in zip(first, second, strict=True))
