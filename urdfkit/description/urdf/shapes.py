"""Poses and shapes of a description, in metres and radians."""

from urdfkit.record import record

Vector = tuple[float, float, float]


@record
class Pose:
    """An ``<origin>``: translation [m] and fixed-axis roll, pitch, yaw [rad], also of a ``quat_xyzw``."""

    xyz: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)


@record
class Box:
    """Full edge lengths [m]."""

    size: Vector


@record
class Cylinder:
    """Axis along z; `radius` and full `length` [m]."""

    radius: float
    length: float


@record
class Sphere:
    """`radius` [m]."""

    radius: float


@record
class Capsule:
    """Axis along z; `radius` and `length` of the cylindrical part [m]."""

    radius: float
    length: float


@record
class Mesh:
    """A mesh, by its URI in the description (``package://…``, ``file://…``, relative path)."""

    uri: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry = Box | Cylinder | Sphere | Capsule | Mesh
