"""Position limits of joints, and the error for a position outside them."""

from urdfkit.description.urdf.robot import Joint
from urdfkit.errors import KinematicsError

UNITS = {"revolute": "rad", "continuous": "rad", "prismatic": "m"}
"""Joint type → unit of its position."""


class JointLimitError(KinematicsError):
    """A joint position outside its limits.

    Attributes:
        joint: name of the joint.
        value: the requested position [rad] or [m].
        lower: the lower limit [rad] or [m].
        upper: the upper limit [rad] or [m].
    """

    def __init__(self, joint: Joint, value: float, lower: float, upper: float) -> None:
        self.joint = joint.name
        self.value = value
        self.lower = lower
        self.upper = upper
        unit = UNITS[joint.type or ""]
        super().__init__(
            f"joint `{joint.name}` at {value:.6g} {unit} is outside its limits [{lower:.6g}, {upper:.6g}] {unit}"
        )


def position_limits(joint: Joint) -> tuple[float, float]:
    """Return the lower and upper position of a joint [rad] or [m]; infinite where the joint is unlimited.

    Attributes missing in ``<limit>`` have URDF's default, 0 (http://wiki.ros.org/urdf/XML/joint). A revolute
    or prismatic joint without any ``<limit>`` counts as unbounded.
    """
    if joint.type not in ("revolute", "prismatic") or joint.limit is None:
        return float("-inf"), float("inf")
    lower, upper = joint.limit.lower, joint.limit.upper
    return (0.0 if lower is None else lower), (0.0 if upper is None else upper)
