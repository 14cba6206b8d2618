"""I520 inertia-unlike-shapes."""

from __future__ import annotations

from math import dist

from urdfkit.description.urdf.robot import Link, Mesh
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.inertia.inertia_from_shapes import computed, place_and_help, tensor_of
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_EQUAL = 0.05
"""Largest relative difference of moments that were computed from the shapes."""

_UNLIKE = 1.6
"""Smallest ratio of a moment to that of the shapes, or the reverse, that is reported."""

_HOLLOW = 2.0
"""Largest ratio of a moment of a hollow part, whose mass is in its surface, to that of a solid part."""

_FEWEST = 4
"""Smallest number of links with the moments of their shapes."""

_SHARE = 3
"""Smallest number of links with the moments of their shapes for each other link."""

_SMALL = 0.02
"""Largest diagonal of a placeholder [m]."""


class InertiaUnlikeShapes(RobotRule):
    """The moments of inertia of a single link do not match its shapes.

    ## What it does
    Compares ixx, iyy and izz of each link with the moments of its box, cylinder or sphere at uniform density. Reports
    the only tensor with a moment that differs by a factor of more than 1.6, if the tensors of at least four links, and
    of three quarters of all links, agree with their shapes within 5 %. Links that share a macro call or an
    ``<inertia>`` element count as one link. Two kinds of links are not compared:

    - links whose centre of mass is not the centre of the shape
    - hollow parts: each of their moments is one to two times that of the solid shape

    ## Why is this bad?
    Usually a formula contains the wrong size, or the macro that computes the inertia has a wrong argument. The part
    swings faster or slower than the real one.

    ## Example
    ```diff
     <robot name="posts" xmlns:xacro="http://www.ros.org/wiki/xacro">
       <xacro:macro name="post" params="name size">
         <link name="${name}">
           <visual><geometry><box size="${size} ${size} 0.5"/></geometry></visual>
           <inertial>
             <mass value="1"/>
             <inertia ixx="${(size**2 + 0.25) / 12}" ixy="0" ixz="0" iyy="${(size**2 + 0.25) / 12}" iyz="0"
                      izz="${size**2 / 6}"/>
           </inertial>
         </link>
       </xacro:macro>
       <link name="base"/>
       <xacro:post name="a" size="0.1"/>
       <xacro:post name="b" size="0.2"/>
       <xacro:post name="c" size="0.12"/>
       <xacro:post name="d" size="0.14"/>
       <link name="top">
         <visual><geometry><box size="0.4 0.2 0.1"/></geometry></visual>
         <inertial>
           <mass value="1"/>
    -      <inertia ixx="0.0041667" ixy="0" ixz="0" iyy="0.0083333" iyz="0" izz="0.01"/>
    +      <inertia ixx="0.0041667" ixy="0" ixz="0" iyy="0.0141667" iyz="0" izz="0.0166667"/>
         </inertial>
       </link>
       <joint name="base_a" type="fixed"><parent link="base"/><child link="a"/></joint>
       <joint name="base_b" type="fixed"><parent link="base"/><child link="b"/><origin xyz="1 0 0"/></joint>
       <joint name="base_c" type="fixed"><parent link="base"/><child link="c"/><origin xyz="0 1 0"/></joint>
       <joint name="base_d" type="fixed"><parent link="base"/><child link="d"/><origin xyz="1 1 0"/></joint>
       <joint name="base_top" type="fixed"><parent link="base"/><child link="top"/><origin xyz="0 0 1"/></joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix writes the tensor of the shapes, but the sizes of the shapes may be wrong.
    """

    code = "I520"
    name = "inertia-unlike-shapes"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for the only tensor that is not that of the shapes of its link."""
        if model.is_incomplete:
            return
        right: list[Element] = []
        wrong: list[tuple[Link, Element, tuple[float, ...]]] = []
        for link in model.robot.links:
            compared = _compared(link, model)
            if compared is None:
                continue
            element, actual, expected = compared
            ratios = [max(a, b) / min(a, b) for a, b in zip(actual, expected, strict=True)]
            if max(ratios) <= 1.0 + _EQUAL:
                right.append(element)
            elif max(ratios) >= _UNLIKE and not _is_hollow(actual, expected):
                wrong.append((link, element, expected))
        if not wrong or len(right) < max(_FEWEST, _SHARE * len(wrong)):
            return
        places = [place_and_help(element, right) for _, element, _ in wrong]
        if len({place.origin.position if isinstance(place, Element) else place for place, _ in places}) > 1:
            return
        for (link, element, expected), (place, _) in zip(wrong, places, strict=True):
            shown = " ".join(f"{value:.3g}" for value in expected)
            message = f"ixx, iyy and izz of link `{link.name}` are not the moments of its shapes, {shown} kg·m², "
            message += "unlike those of the other links"
            help = "check the formula, its sizes and the arguments of the macro"
            fix = computed(model, link, element) if not element.origin.expansions else None
            yield self.at(model, place, message, link=link.name, help=help, fix=fix)


def _is_hollow(actual: tuple[float, ...], expected: tuple[float, ...]) -> bool:
    """Return whether moments can be those of a part whose mass is in the surface of its shape."""
    ratios = [a / b for a, b in zip(actual, expected, strict=True)]
    return all(1.0 - _EQUAL <= ratio <= _HOLLOW * (1.0 + _EQUAL) for ratio in ratios)


def _compared(link: Link, model: Model) -> tuple[Element, tuple[float, ...], tuple[float, ...]] | None:
    """Return the ``<inertia>`` of a link, its moments and those of the shapes; None if they cannot be compared."""
    inertial, extent = link.inertial, model.extents.get(link.name)
    if inertial is None or inertial.inertia is None or not inertial.mass or inertial.mass <= 0.0 or extent is None:
        return None
    if (
        extent.diagonal <= _SMALL
        or len(link.collisions or link.visuals) != 1
        or any(isinstance(shape.geometry, Mesh) for shape in shapes_of(link))
    ):
        return None
    shape = (link.collisions or link.visuals)[0]
    if dist(shape.origin.xyz, inertial.origin.xyz) > _EQUAL * extent.diagonal:
        return None  # The mass is distributed in another way.
    inertia, element = inertial.inertia, inertial.element.find("inertia")
    actual = (inertia.ixx, inertia.iyy, inertia.izz)
    tensor = tensor_of(link, extent, inertial.mass)
    if tensor is None or element is None or min(actual) <= 0.0 or min(tensor[0], tensor[3], tensor[5]) <= 0.0:
        return None
    if any(model.is_unresolved(each) for each in inertial.element.walk()):
        return None
    return element, actual, (tensor[0], tensor[3], tensor[5])
