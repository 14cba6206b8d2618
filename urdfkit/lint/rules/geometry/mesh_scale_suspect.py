"""G604 mesh-scale-suspect."""

import re
from bisect import bisect_left, bisect_right
from collections.abc import Sequence
from math import dist, sqrt

from urdfkit.description.urdf.geometry import box_around
from urdfkit.description.urdf.principal_moments import principal_moments
from urdfkit.description.urdf.robot import Link, Mesh
from urdfkit.lint.fix_builders import more_attributes, new_value
from urdfkit.lint.model.placement import offset_of, shapes_of
from urdfkit.lint.rule import Findings, Model, RobotRule

MAX_RATIO = 50.0
"""Largest plausible ratio between the sizes of parts of one robot."""

LARGE = 50.0
"""[m] Larger meshes are compared with sizes that do not depend on meshes."""

MAX_SIZE = 100.0
"""[m] Largest plausible size if the robot has no other size to compare with."""

MAX_BUILDING = 500.0
"""[m] Largest plausible size of a building or ground."""

_BUILDING = r"(?<![a-z])(?:building|environment|floor|ground|hall|house|map|room|terrain|walls?|warehouse)(?![a-z])"


class MeshScaleSuspect(RobotRule):
    """A mesh is about a thousand times larger or smaller than the rest of the robot.

    ## What it does
    Compares the scaled size of a mesh with the median of the distances between joints and the sizes of the other
    shapes. Because all meshes may have the same wrong scale, meshes of more than 50 m are also compared with sizes that
    do not depend on meshes: distances between joints, and the sizes of boxes, cylinders and spheres. If the robot has
    none of these, a mesh is compared with the radius of gyration √(I/m) of its link. If the link has no inertia either,
    meshes of more than 100 m are reported. Buildings and ground planes, recognised by the names of the root link and
    its mesh, are not checked.

    ## Why is this bad?
    CAD programs often export millimetres, but URDF expects metres. The part is huge, or too small to see.

    ## Example
    ```diff
     <robot name="arm">
       <link name="base">
         <visual><geometry><box size="0.2 0.2 0.1"/></geometry></visual>
       </link>
       <link name="tool">
    -    <visual><geometry><mesh filename="meshes/block_in_mm.stl"/></geometry></visual>
    +    <visual><geometry><mesh filename="meshes/block_in_mm.stl" scale="0.001 0.001 0.001"/></geometry></visual>
       </link>
       <joint name="mount" type="fixed">
         <parent link="base"/>
         <child link="tool"/>
       </joint>
     </robot>
    ```

    ## Fix safety
    Unsafe: the fix divides or multiplies the scale by 1000, but the mesh may be correct.
    """

    code = "G604"
    name = "mesh-scale-suspect"
    severity = "warning"
    fix = "unsafe"

    def check(self, model: Model) -> Findings:
        """Yield a finding for each mesh that is far too large or too small."""
        sized_meshes = [(mesh, element, link, _size(model, mesh)) for mesh, element, link in model.meshes]
        if not any(size for *_, size in sized_meshes):
            return
        references = _reference_sizes(model)
        children = {joint.child for joint in model.robot.joints}
        every = sorted([*references, *(size for *_, size in sized_meshes)])
        own: dict[str, list[float]] = {}
        for mesh, _, _, size in sized_meshes:
            own.setdefault(mesh.uri, []).append(size)
        for mesh, element, link, size in sized_meshes:
            median = _median(every, sorted(own[mesh.uri]))
            if size > LARGE and not _is_other_unit(size, median):
                median = _median(sorted(references)) or _radius_of_gyration(link)
            is_fixed = link.name not in children and median < size <= MAX_BUILDING
            if is_fixed and re.search(_BUILDING, f"{link.name} {mesh.uri}", re.IGNORECASE):
                continue
            is_alone = not median and size > MAX_SIZE
            if not (is_alone or _is_other_unit(size, median)):
                continue
            comparison = "" if is_alone else f"; the median size of the parts of the robot is {median:.2g} m"
            factor, defect = (0.001, "large") if size > median else (1000.0, "small")
            if defect == "large" and set(mesh.scale) == {100.0}:
                factor = 0.01
            scale = " ".join(f"{part * factor:g}" for part in mesh.scale)
            fix = (
                new_value(model, element, "scale", scale, "unsafe", f"Scale by {scale}")
                if element.get("scale") is not None
                else more_attributes(model, element, f'scale="{scale}"', "unsafe", f"Scale by {scale}")
            )
            message = f"mesh of link `{link.name}` has a size of {size:.3g} m{comparison}"
            help = f'set scale="{scale}" if the mesh is too {defect} by a factor of {max(factor, 1.0 / factor):g}'
            yield self.at(model, element, message, attribute="scale", link=link.name, help=help, fix=fix)


def _is_other_unit(size: float, median: float) -> bool:
    """Whether a size differs so much from the median that only another unit explains it."""
    return bool(size and median) and (MAX_RATIO < size / median < 10000.0 or MAX_RATIO < median / size < 10000.0)


def _median(ordered: list[float], own: Sequence[float] = ()) -> float:
    """Return the median of sorted sizes [m], without those below a tenth of a millimetre; 0 without any.

    Args:
        ordered: the sizes, sorted.
        own: the sizes among them that do not count, sorted.
    """
    first, last = bisect_right(ordered, 1e-4) - bisect_right(own, 1e-4), len(ordered) - len(own)
    if first >= last:
        return 0.0
    middle = (first + last) // 2
    for number, size in enumerate(own):
        middle += bisect_left(ordered, size) + number - bisect_left(own, size) <= middle
    return ordered[middle]


def _reference_sizes(model: Model) -> list[float]:
    """Return the distances between joints and the sizes of shapes other than meshes [m]."""
    sizes = model.facts.of(offset_of, model.robot.joints).copy()
    extents, links = model.extents, model.robot.links
    for link, (others, has_mesh) in zip(links, model.facts.of(_other_sizes, links), strict=True):
        if not has_mesh and link.name in extents:
            sizes.append(extents[link.name].diagonal)
        else:  # A shape next to a mesh has about the same size.
            sizes += others
    return sizes


def _other_sizes(link: Link) -> tuple[list[float], bool]:
    """Return the sizes of the shapes of a link that are no meshes [m], and whether it has a mesh."""
    shapes = shapes_of(link)
    primitives = [shape for shape in shapes if not isinstance(shape.geometry, Mesh)]
    corners = (box_around(shape.geometry, shape.origin) for shape in primitives if shape.geometry is not None)
    return [dist(low, high) for low, high in corners], len(primitives) < len(shapes)


def _radius_of_gyration(link: Link) -> float:
    """Return the largest radius of gyration of a link [m]; 0 if unknown."""
    mass = link.inertial.mass if link.inertial is not None else None
    largest = max((moments[2] for moments, _ in principal_moments(link)), default=0.0)
    return sqrt(largest / mass) if mass is not None and mass > 0.0 and largest > 0.0 else 0.0


def _size(model: Model, mesh: Mesh) -> float:
    """Return the diagonal of the bounding box of a mesh [m]; 0 if unknown."""
    box = model.box_of(mesh)
    return 0.0 if box is None else sum(part * part for part in box[1]) ** 0.5
