"""I518 twins-differ."""

from collections import Counter
from collections.abc import Iterator

from urdfkit.description.urdf.robot import Link, Mesh
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.twins import Twins, decimal_slip, links_of, twins
from urdfkit.lint.model.placement import shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

_RATIO = 2.0
"""Smallest ratio of the masses or sizes of a left and a right part that differ by mistake."""


class TwinsDiffer(RobotRule):
    """A part and its counterpart on the other side, or at the other end, differ in mass or size.

    ## What it does
    Compares child links of the same parent if the names of their joints differ only in a side (``left`` and ``right``)
    or an end (``front`` and ``rear``). Reports a left and a right part if their masses or sizes differ by a factor of
    two, and a front and a rear part if their masses or sizes differ by a factor of 10, 100 or 1000. Meshes are also
    compared by their ``scale``.

    ## Why is this bad?
    The robot leans or drifts, or one of its wheels is too small to reach the ground. The usual cause is a wrong decimal
    point or unit.

    ## Example
    ```diff
     <robot name="cart">
       <link name="base">
         <inertial>
           <mass value="8"/>
           <inertia ixx="0.0667" ixy="0" ixz="0" iyy="0.1733" iyz="0" izz="0.2267"/>
         </inertial>
       </link>
       <link name="left_wheel">
         <inertial>
           <mass value="1"/>
           <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/>
         </inertial>
       </link>
       <link name="right_wheel">
         <inertial>
    -      <mass value="10"/>
    +      <mass value="1"/>
           <inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/>
         </inertial>
       </link>
       <joint name="left_wheel_joint" type="continuous">
         <parent link="base"/><child link="left_wheel"/><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
       </joint>
       <joint name="right_wheel_joint" type="continuous">
         <parent link="base"/><child link="right_wheel"/><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/>
       </joint>
     </robot>
    ```
    """

    code = "I518"
    name = "twins-differ"
    severity = "warning"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link whose mass, else size, differs from that of its counterparts."""
        if model.is_damaged:
            return
        differences = list(_differences(model))
        counts = Counter((what, link.name) for links, what, *_ in differences for link in links)
        found: set[tuple[str, str]] = set()
        for links, what, values, unit in differences:
            wrong = links[values.index(max(values))]
            if counts[what, links[0].name] != counts[what, links[1].name]:
                wrong = max(links, key=lambda link: counts[what, link.name])
            if not found.isdisjoint((what, link.name) for link in links):
                continue
            found.add((what, wrong.name))
            x, y = (f"{value:.3g} {unit}".strip() for value in values)
            what_differs = "the scale of their meshes" if what == "scale" else what
            message = f"`{links[0].name}` and `{links[1].name}` differ in {what_differs}: {x} and {y}"
            help = "check the decimal points and units of both"
            attribute = {"mass": "value", "scale": "scale"}.get(what)
            yield self.at(model, _place(wrong, what), message, attribute=attribute, link=wrong.name, help=help)


def _differences(model: Model) -> Iterator[tuple[tuple[Link, Link], str, list[float], str]]:
    """Yield the links of each pair that differs, with what differs, its values and its unit."""
    for pair in twins(model):
        links = links_of(pair, model)
        if links is None or any(not link.name or links[0] is links[1] for link in links):
            continue
        masses = [link.inertial.mass or 0.0 if link.inertial is not None else 0.0 for link in links]
        extents = [model.extents.get(link.name) for link in links]
        sizes = [extent.diagonal if extent is not None else 0.0 for extent in extents]
        scales = [_scale(link) for link in links]
        for values, what, unit in ((masses, "mass", "kg"), (sizes, "size", "m"), (scales, "scale", "")):
            if min(values) > 0.0 and _differ(pair, values):
                yield links, what, values, unit
                break


def _scale(link: Link) -> float:
    """Return the scale of the only mesh among the visual shapes of a link; 0 without one."""
    meshes = [shape.geometry for shape in link.visuals if isinstance(shape.geometry, Mesh)]
    return max(abs(part) for part in meshes[0].scale) if len(meshes) == 1 else 0.0


def _place(link: Link, what: str) -> Element:
    """Return the element with the mass or the shape of a link."""
    found = link.inertial.element.find("mass") if what == "mass" and link.inertial is not None else None
    if what in ("size", "scale"):
        geometry = next((shape.element.find("geometry") for shape in shapes_of(link)), None)
        found = geometry.children[0] if geometry is not None and geometry.children else geometry
    return found or link.element


def _differ(pair: Twins, values: list[float]) -> bool:
    """Return whether a quantity of twins differs so much that one of the values is wrong."""
    return max(values) >= _RATIO * min(values) if pair.are_sides else bool(decimal_slip(*values))
