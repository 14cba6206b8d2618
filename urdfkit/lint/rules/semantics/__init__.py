"""Rules on what the robot means: wheels, sides, optical frames."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    return ()
