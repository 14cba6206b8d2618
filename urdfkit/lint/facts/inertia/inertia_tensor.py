"""The inertia tensor of a link's shapes, in plain Python: what rules compare with and fixes write."""

from __future__ import annotations

from urdfkit.description.urdf.robot import Box, Capsule, Cylinder, Sphere
from urdfkit.lint.edits import new_values
from urdfkit.lint.model.placement import Extent, rotation, volume_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.description.urdf.robot import Geometry, Link, Vector
    from urdfkit.description.xml.element import Element
    from urdfkit.lint.finding import Fix
    from urdfkit.lint.model.model import Model

COMPONENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
"""The entries of a tensor, as URDF names them."""

Rows = list[list[float]]


def tensor_of(link: Link, extent: Extent, mass: float) -> tuple[float, ...] | None:
    """Return the six entries [kg·m²] of a link's shapes filled evenly with `mass` [kg], in its inertial frame.

    Collision shapes count; visual ones where there are none. Shapes that overlap count twice, and of a mesh the box
    around it is taken. The tensor is about the shapes' own centre of mass. None where they have no volume.
    """
    count = len(link.visuals)
    shapes = extent.shapes[count:] or extent.shapes[:count]
    volumes = [volume_of(shape) for shape, _ in shapes]
    if sum(volumes) <= 0.0:
        return None
    if len(shapes) == 1 and shapes[0][1].rpy == (0.0, 0.0, 0.0) and not _is_turned(link):
        xx, yy, zz = _diagonal(shapes[0][0], mass)
        return xx, 0.0, 0.0, yy, 0.0, zz
    masses = [mass * volume / sum(volumes) for volume in volumes]
    poses = [pose for _, pose in shapes]
    centre = [sum(m * pose.xyz[i] for m, pose in zip(masses, poses, strict=True)) / mass for i in range(3)]
    total: Rows = [[0.0] * 3 for _ in range(3)]
    for (shape, pose), m in zip(shapes, masses, strict=True):
        rows, diagonal = rotation(pose.rpy), _diagonal(shape, m)
        offset = [pose.xyz[i] - centre[i] for i in range(3)]
        square = sum(part * part for part in offset)
        for i in range(3):
            for j in range(3):
                own = sum(rows[i][k] * diagonal[k] * rows[j][k] for k in range(3))
                total[i][j] += own + m * ((square if i == j else 0.0) - offset[i] * offset[j])
    frame = rotation(link.inertial.origin.rpy) if link.inertial is not None else rotation((0.0, 0.0, 0.0))
    turned = [
        [sum(frame[k][i] * total[k][n] * frame[n][j] for k in range(3) for n in range(3)) for j in range(3)]
        for i in range(3)
    ]
    return turned[0][0], turned[0][1], turned[0][2], turned[1][1], turned[1][2], turned[2][2]


def _is_turned(link: Link) -> bool:
    return link.inertial is not None and link.inertial.origin.rpy != (0.0, 0.0, 0.0)


def computed(model: Model, link: Link, element: Element) -> Fix | None:
    """Return the fix that writes the tensor of the link's shapes; None where they, or the mass, are not known."""
    extent = model.extents.get(link.name)
    mass = link.inertial.mass if link.inertial is not None else None
    if extent is None or mass is None or mass <= 0.0:
        return None
    values = tensor_of(link, extent, mass)
    if values is None:
        return None
    largest = max(values)
    texts = {name: _written(value, largest) for name, value in zip(COMPONENTS, values, strict=True)}
    return new_values(model, element, texts, "unsafe", "Compute it from shape and mass")


def _written(value: float, largest: float) -> str:
    return "0" if abs(value) < 1e-9 * largest else f"{value:.6g}"


def squares(shape: Geometry) -> Vector:
    """Return the mean of x², y² and z² over a solid about its middle [m²] (any textbook)."""
    if isinstance(shape, Box):
        x, y, z = (size * size / 12.0 for size in shape.size)
        return x, y, z
    if isinstance(shape, Sphere):
        square = shape.radius**2 / 5.0
        return square, square, square
    if isinstance(shape, Cylinder):
        return shape.radius**2 / 4.0, shape.radius**2 / 4.0, shape.length**2 / 12.0
    if isinstance(shape, Capsule):
        r, h = shape.radius, shape.length
        middle, ends = h, 4.0 / 3.0 * r  # volumes over πr²
        across = (middle * r**2 / 4.0 + ends * r**2 / 5.0) / (middle + ends)
        along = (middle * h**2 / 12.0 + ends * (h**2 / 4.0 + 3.0 / 8.0 * h * r + r**2 / 5.0)) / (middle + ends)
        return across, across, along
    return 0.0, 0.0, 0.0


def _diagonal(shape: Geometry, mass: float) -> Vector:
    """Return the principal moments of a solid about its middle [kg·m²]."""
    x, y, z = squares(shape)
    return mass * (y + z), mass * (x + z), mass * (x + y)
