"""Rules on what the robot means: wheels, sides, optical frames."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.semantics.double_offset import DoubleOffset
    from urdfkit.lint.rules.semantics.left_right_swapped import LeftRightSwapped
    from urdfkit.lint.rules.semantics.optical_frame import OpticalFrame
    from urdfkit.lint.rules.semantics.wheel_diameter import WheelDiameter
    from urdfkit.lint.rules.semantics.wheel_separation import WheelSeparation

    return (
        WheelSeparation,
        WheelDiameter,
        LeftRightSwapped,
        OpticalFrame,
        DoubleOffset,
    )
