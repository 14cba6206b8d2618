"""G604 mesh-scale-suspect."""

from __future__ import annotations

from math import dist, sqrt

from urdfkit.description.robot import Mesh
from urdfkit.lint.edits import more_attributes, new_value
from urdfkit.lint.meshes import meshes
from urdfkit.lint.placement import box_around, shapes_of
from urdfkit.lint.principal import principal_moments
from urdfkit.lint.rule import RobotRule

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterator

    from urdfkit.description.robot import Link
    from urdfkit.lint.finding import Finding
    from urdfkit.lint.model import Model

FAR = 50.0
"""Parts of one robot may well be of such different sizes."""

HUGE = 50.0
"""[m] across: ships and halls are, but then their other parts tell."""

ALONE = 100.0
"""[m] across: too much where nothing else tells how large things are."""


class MeshScaleSuspect(RobotRule):
    """A mesh is about a thousand times as large, or small, as the robot around it.

    ## What it does
    Compares the size of a mesh, scale included, with the middle of the distances between joints and of the other
    shapes. Where all meshes may be wrong alike, one of more than 50 m is compared with what else tells how large
    things are: the distances between joints, boxes, cylinders and spheres, else the radius of gyration √(I/m) of its
    link. Where nothing does, 100 m are too much.

    ## Why is this bad?
    CAD programs write millimetres, URDF means metres: the part fills the sky, or cannot be seen.

    ## Example
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
      </link>
      <link name="tool">
        <visual><geometry><mesh filename="meshes/block_in_mm.stl"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="tool"/>
        <origin xyz="0 0 0.1"/>
      </joint>
    </robot>
    ```

    ## Use instead
    ```xml
    <robot name="arm">
      <link name="base">
        <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
      </link>
      <link name="tool">
        <visual><geometry><mesh filename="meshes/block_in_mm.stl" scale="0.001 0.001 0.001"/></geometry></visual>
      </link>
      <joint name="mount" type="fixed">
        <parent link="base"/>
        <child link="tool"/>
        <origin xyz="0 0 0.1"/>
      </joint>
    </robot>
    ```

    ## Fix safety
    Unsafe: the scale is divided, or multiplied, by 1000.
    """

    code = "G604"
    name = "mesh-scale-suspect"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Iterator[Finding]:
        """Yield a finding for each mesh that is far too large or small."""
        found = [(mesh, element, link, _diagonal(model, mesh)) for mesh, element, link in meshes(model)]
        if not any(size for *_, size in found):
            return
        sure = _lengths(model)
        for mesh, element, link, size in found:
            middle = _middle([*sure, *(other for m, *_, other in found if m.uri != mesh.uri)])
            if size > HUGE and not _is_far(size, middle):
                middle = _middle(sure) or _gyration(link)
            is_alone = not middle and size > ALONE
            if not (is_alone or _is_far(size, middle)):
                continue
            beside = "" if is_alone else f" in a robot of parts of about {middle:.2g} m"
            factor, what = (0.001, "large") if size > middle else (1000.0, "small")
            if what == "large" and set(mesh.scale) == {100.0}:
                factor = 0.01
            scale = " ".join(f"{part * factor:g}" for part in mesh.scale)
            fix = (
                new_value(model, element, "scale", scale, "unsafe", f"Scale by {scale}")
                if element.get("scale") is not None
                else more_attributes(model, element, f'scale="{scale}"', "unsafe", f"Scale by {scale}")
            )
            yield self.at(
                model,
                element,
                f"the mesh of link `{link.name}` is {size:.3g} m across{beside}",
                attribute="scale",
                link=link.name,
                help=f'too {what} by {max(factor, 1.0 / factor):g}? URDF means metres: scale="{scale}"',
                fix=fix,
            )


def _is_far(size: float, middle: float) -> bool:
    """Whether a size is so far from the middle of the others that only another unit explains it."""
    return bool(size and middle) and (FAR < size / middle < 10000.0 or FAR < middle / size < 10000.0)


def _middle(sizes: list[float]) -> float:
    known = sorted(size for size in sizes if size > 1e-4)
    return known[len(known) // 2] if known else 0.0


def _lengths(model: Model) -> list[float]:
    """Return how far joints are from each other, and how large the links without meshes are [m]."""
    sizes = [sum(part * part for part in joint.origin.xyz) ** 0.5 for joint in model.robot.joints]
    for link in model.robot.links:
        plain = [shape for shape in shapes_of(link) if not isinstance(shape.geometry, Mesh)]
        if link.name in model.extents and len(plain) == len(shapes_of(link)):
            sizes.append(model.extents[link.name].diagonal)
        elif plain:  # What stands beside a mesh is about as large as that.
            corners = (box_around(shape.geometry, shape.origin) for shape in plain if shape.geometry is not None)
            sizes += [dist(low, high) for low, high in corners]
    return sizes


def _gyration(link: Link) -> float:
    """Return the largest radius of gyration of a link [m]; 0 where that is not known."""
    mass = link.inertial.mass if link.inertial is not None else None
    largest = max((moments[2] for moments, _ in principal_moments(link)), default=0.0)
    return sqrt(largest / mass) if mass is not None and mass > 0.0 and largest > 0.0 else 0.0


def _diagonal(model: Model, mesh: Mesh) -> float:
    """Return how large a mesh is [m]; 0 where that is not known."""
    box = model.box_of(mesh)
    return 0.0 if box is None else sum(part * part for part in box[1]) ** 0.5
