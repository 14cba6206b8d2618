"""Position limits of joints, and the error for a position outside them."""

from collections.abc import Mapping

from urdfkit.description.urdf.robot import Joint, Robot
from urdfkit.errors import KinematicsError
from urdfkit.kinematics.mimic import couplings

UNITS = {"revolute": "rad", "continuous": "rad", "prismatic": "m"}
"""Joint type → unit of its position."""


class JointLimitError(KinematicsError):
    """A joint position outside its limits.

    Attributes:
        joint: name of the joint.
        value: the requested position [rad] or [m].
        lower: the lower limit [rad] or [m].
        upper: the upper limit [rad] or [m].

    Examples:
        >>> import urdfkit
        >>> arm = urdfkit.Kinematics("seven_dof_arm")
        >>> for error in arm.limit_errors({"elbow_pitch_joint": 9.0}):
        ...     print(error.joint, error.value, error.upper)
        elbow_pitch_joint 9.0 1.933
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


def limit_errors(robot: Robot, positions: Mapping[str, float]) -> list[JointLimitError]:
    """Return an error, not raised, for each joint outside its limits, mimic joints of the given joints included.

    Args:
        robot: the robot.
        positions: joint → position [rad] or [m]; other names are ignored.

    Raises:
        KinematicsError: see `urdfkit.kinematics.mimic.couplings`.
    """
    values = dict(positions)
    for name, coupling in couplings(robot).items():
        if coupling.master is not None and coupling.master in positions:
            values[name] = coupling.multiplier * positions[coupling.master] + coupling.offset
    found = []
    for name, value in values.items():
        if (joint := robot.joint_by_name.get(name)) is not None:
            lower, upper = position_limits(joint)
            if not lower <= value <= upper:
                found.append(JointLimitError(joint, value, lower, upper))
    return found
