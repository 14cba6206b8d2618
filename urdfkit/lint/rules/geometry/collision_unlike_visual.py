"""G620 collision-unlike-visual."""

from math import dist, inf, log10, prod

from urdfkit.description.urdf.geometry import box_around, box_around_all
from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Geometry, Link, Mesh, Pose, Sphere, Vector
from urdfkit.description.xml.element import Element
from urdfkit.lint.facts.twins import decimal_slip
from urdfkit.lint.rule import Findings, Model, RobotRule

_ALIKE = 0.15
"""Largest relative difference of sizes that agree."""

_UNLIKE = 1.6
"""Smallest ratio of sizes that contradict each other."""

_TIMES = 3.0
"""Ratio of the sizes of collision and visual shape that a simplification does not explain."""

_WHEEL = 0.1
"""Largest relative difference of the radii of a wheel."""

_DISTANCE = 0.4
"""Distance of equal shapes, as a part of their largest size."""

_SMALLEST = 0.005
"""Smallest size that is compared [m]."""

_ROUND = 0.03
"""Largest relative difference of two sizes of a mesh that is a disc."""

Corners = tuple[Vector, Vector]
Shapes = tuple[tuple[Geometry, Pose], ...]


class CollisionUnlikeVisual(RobotRule):
    """The collision shape of a link differs from its visual shape in orientation, place or size.

    ## What it does
    Compares the collision shapes of a link with its visual shapes. Reports:

    - shapes of about the same size in different poses
    - cylinders and boxes with the same dimensions in a different order
    - a single collision shape that is at least three times larger or smaller than the visual shape of the same kind, in
      all directions or, for a box, in two of them
    - shapes with a misplaced decimal point in one dimension
    - wheels whose visual and collision radius differ

    ## Why is this bad?
    The robot collides where nothing is visible, or passes through visible parts. Usually an ``<origin>`` or a size was
    changed in only one of the two shapes.

    ## Example
    ```diff
     <robot name="cart">
       <link name="wheel">
         <inertial><mass value="1"/><inertia ixx="0.004" ixy="0" ixz="0" iyy="0.004" iyz="0" izz="0.004"/></inertial>
         <visual>
           <origin rpy="1.5707963267948966 0 0"/>
           <geometry><cylinder radius="0.1" length="0.04"/></geometry>
         </visual>
         <collision>
    +      <origin rpy="1.5707963267948966 0 0"/>
           <geometry><cylinder radius="0.1" length="0.04"/></geometry>
         </collision>
       </link>
     </robot>
    ```
    """

    code = "G620"
    name = "collision-unlike-visual"
    severity = "warning"
    checks_each_alone = True

    def check(self, model: Model) -> Findings:
        """Yield a finding for each link whose collision shapes contradict its visual shapes."""
        wheels = {joint.child for joint in model.robot.joints if joint.type == "continuous"}
        for link in model.robot.links:
            extent, count = model.extents.get(link.name), len(link.visuals)
            if extent is None or not count or not link.collisions or len(extent.shapes) != count + len(link.collisions):
                continue
            visuals, collisions = extent.shapes[:count], extent.shapes[count:]
            if visuals == collisions:
                continue
            found = _of_wheel(visuals, collisions) if link.name in wheels else None
            found = found or _defect(visuals, collisions)
            if found is not None:
                message, help, part = found
                shape = link.collisions[0].element
                geometry = shape.find("geometry")
                place = shape.find(part) or shape
                if part != "origin" and geometry is not None and geometry.children:
                    place = geometry.children[0]
                scaled = _scaled(link, visuals, collisions)
                if scaled is not None:
                    mesh, message = scaled
                    help = "check the scale"
                    yield self.at(model, mesh, message, attribute="scale", link=link.name, help=help)
                    continue
                yield self.at(
                    model, place, f"collision shape of link `{link.name}` {message}", link=link.name, help=help
                )


def _scaled(link: Link, visuals: Shapes, collisions: Shapes) -> tuple[Element, str] | None:
    """Return the only mesh of a link whose scale is wrong by a power of ten, with the message; None if it is not."""
    mesh = link.visuals[0].geometry
    if len(visuals) != 1 or not isinstance(mesh, Mesh) or mesh.scale == (1.0, 1.0, 1.0):
        return None
    boxes = [box_around_all([box_around(*each) for each in group]) for group in (visuals, collisions)]
    sizes = [sorted(high - low for low, high in zip(*box, strict=True)) for box in boxes]
    factors = [a / max(b, 1e-9) for a, b in zip(*sizes, strict=True)]
    power = 10.0 ** round(log10(max(factors[2], 1e-9)))
    geometry = link.visuals[0].element.find("geometry")
    if power == 1.0 or any(abs(factor - power) > _ROUND * power for factor in factors):
        return None
    if geometry is None or not geometry.children:
        return None
    message = f"visual mesh of link `{link.name}` is {power:g} times as large as the collision shape"
    return geometry.children[0], message


def _of_wheel(visuals: Shapes, collisions: Shapes) -> tuple[str, str, str] | None:
    """Return the defect of a wheel that is a cylinder twice, with the same width and pose; None if the radii agree."""
    if len(visuals) != 1 or len(collisions) != 1 or visuals[0][1] != collisions[0][1]:
        return None
    (visual, _), (collision, _) = visuals[0], collisions[0]
    if not (isinstance(visual, Cylinder) and isinstance(collision, Cylinder)) or visual.length != collision.length:
        return None
    low, high = sorted((visual.radius, collision.radius))
    if not 0.0 < low < (1.0 - _WHEEL) * high:
        return None
    message = f"has a radius of {collision.radius:.3g} m, but that of the visual shape is {visual.radius:.3g} m"
    return message, "write the radius of the wheel in both shapes", "geometry"


def _defect(visuals: Shapes, collisions: Shapes) -> tuple[str, str, str] | None:
    """Return message, help and the tag of the element to report; None if the shapes agree."""
    if len(collisions) == 1:
        equal = [pose for shape, pose in visuals if shape == collisions[0][0]]
        if len(visuals) > 1 and len(equal) == 1:
            visuals = tuple(each for each in visuals if each[1] is equal[0])
    boxes = [box_around_all([box_around(*each) for each in group]) for group in (visuals, collisions)]
    sizes = [tuple(high - low for low, high in zip(*box, strict=True)) for box in boxes]
    if min(max(each) for each in sizes) < _SMALLEST:
        return None
    pairs = [zip(*each, strict=True) for each in (sizes, [sorted(each) for each in sizes])]
    ratios, ordered = ([max(a, b) / max(min(a, b), 1e-9) for a, b in each] for each in pairs)
    is_single = len(visuals) == len(collisions) == 1
    if max(ordered) <= 1.0 + _ALIKE:
        if max(ratios) >= _UNLIKE:
            part = "shape" if is_single and visuals[0][1] == collisions[0][1] else "origin"
            return "is rotated relative to the visual shape", "write the same <origin> and sizes for both", part
        distance = dist(*([sum(pair) / 2.0 for pair in zip(*box, strict=True)] for box in boxes))
        if distance > _DISTANCE * max(sizes[1]):
            return f"is {distance:.3g} m away from the visual shape", "write the same <origin> for both", "origin"
    if not is_single:
        return None
    (visual, _), (collision, _) = visuals[0], collisions[0]
    if isinstance(visual, Box) and isinstance(collision, Cylinder):  # A mesh is the box around it.
        low, middle, high = sorted(sizes[0])
        is_disc = middle > (1.0 - _ROUND) * high and high > _UNLIKE * low
        if is_disc and _agree((middle / 2.0, low), (collision.length, collision.radius), _ROUND):
            return "has the radius and length of the visual shape swapped", "swap radius and length", "geometry"
    if type(visual) is not type(collision):
        return None
    lengths = _lengths(visual), _lengths(collision)
    if isinstance(visual, Cylinder) and _agree(lengths[0], lengths[1][::-1]) and not _agree(*lengths):
        return "has the radius and length of the visual shape swapped", "swap radius and length", "geometry"
    factors = [b / a for a, b in zip(*lengths, strict=True) if a > 0.0 and b > 0.0]
    if factors and (min(factors) >= _TIMES or max(factors) <= 1.0 / _TIMES):
        times = min(factors) if min(factors) >= _TIMES else max(factors)
        return f"is {times:.3g} times as large as the visual shape", "check the decimal points and units", "geometry"
    times = prod(factors)
    is_one_way = min(factors, default=0.0) > 1.0 - _ALIKE or max(factors, default=inf) < 1.0 + _ALIKE
    is_cube = len(set(lengths[1])) == 1  # A cube around a stick is on purpose.
    slip = [factor for factor in factors if abs(factor - 1.0) > 1e-3]
    if len(slip) == 1 < len(factors) and decimal_slip(slip[0], 1.0):
        message = f"is {slip[0]:.3g} times as large as the visual shape in one direction"
        return message, "check the decimal point", "geometry"
    unlike = [factor for factor in factors if not 1.0 / _TIMES < factor < _TIMES]
    if len(factors) == 3 and len(unlike) > 1 and is_one_way and not is_cube:
        message = f"is {times:.3g} times as large as the visual shape"
        return message, "check whether the size was copied from another link", "geometry"
    return None


def _agree(first: tuple[float, ...], second: tuple[float, ...], tolerance: float = 1e-3) -> bool:
    return all(abs(a - b) <= tolerance * max(a, b) for a, b in zip(first, second, strict=True))


def _lengths(shape: Geometry) -> tuple[float, ...]:
    if isinstance(shape, Box):
        return shape.size
    if isinstance(shape, (Cylinder, Capsule)):
        return shape.radius, shape.length
    return (shape.radius,) if isinstance(shape, Sphere) else ()
