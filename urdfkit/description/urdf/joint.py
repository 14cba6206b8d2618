"""Joint: a joint with its limits and other properties, as in the description.

A value that is missing or could not be read is None. SI units: [m] [rad] [N] [N·m] [m/s] [rad/s].
"""

from urdfkit.description.urdf.shapes import Pose, Vector
from urdfkit.description.xml.element import Element
from urdfkit.record import field, record

JOINT_TYPES = ("fixed", "revolute", "continuous", "prismatic", "planar", "floating")
"""The six joint types of URDF (http://wiki.ros.org/urdf/XML/joint)."""


@record(eq=False)
class Limit:
    """Limits of a joint; None if missing.

    Attributes:
        lower: [rad] or [m].
        upper: [rad] or [m].
        effort: [N·m] or [N].
        velocity: [rad/s] or [m/s].
        element: the ``<limit>``.
        acceleration: [rad/s²] or [m/s²]; since URDF 1.2, like the next two.
        deceleration: [rad/s²] or [m/s²]; if None, the limit of acceleration applies.
        jerk: [rad/s³] or [m/s³].
    """

    lower: float | None
    upper: float | None
    effort: float | None
    velocity: float | None
    element: Element = field(repr=False)
    acceleration: float | None = None
    deceleration: float | None = None
    jerk: float | None = None


@record(eq=False)
class Dynamics:
    """`damping` [N·m·s/rad or N·s/m] and dry `friction` [N·m or N]; zero if missing."""

    damping: float
    friction: float
    element: Element = field(repr=False)


@record(eq=False)
class Mimic:
    """Position = multiplier · (position of `joint`) + offset."""

    joint: str
    multiplier: float
    offset: float
    element: Element = field(repr=False)


@record(eq=False)
class SafetyController:
    """Soft limits and gains of ros_control."""

    soft_lower_limit: float
    soft_upper_limit: float
    k_position: float
    k_velocity: float | None
    element: Element = field(repr=False)


@record(eq=False)
class Calibration:
    """Reference positions [rad or m]."""

    rising: float | None
    falling: float | None
    element: Element = field(repr=False)


@record(eq=False)
class Joint:
    """A joint that connects `child` to `parent`. `type` is None if missing; `axis` is not normalised."""

    name: str
    type: str | None
    parent: str | None
    child: str | None
    origin: Pose
    axis: Vector
    limit: Limit | None
    dynamics: Dynamics | None
    mimic: Mimic | None
    safety_controller: SafetyController | None
    calibration: Calibration | None
    element: Element = field(repr=False)

    @property
    def has_axis(self) -> bool:
        """Whether the axis has a direction: the square of its length is neither zero nor infinite."""
        return 0.0 < sum(part * part for part in self.axis) < float("inf")

    @property
    def is_movable(self) -> bool:
        """Whether the joint has a degree of freedom."""
        return self.type in JOINT_TYPES and self.type != "fixed"
