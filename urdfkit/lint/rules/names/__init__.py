"""Rules on the names of links and joints."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.names.invalid_name_characters import InvalidNameCharacters
    from urdfkit.lint.rules.names.link_joint_same_name import LinkJointSameName
    from urdfkit.lint.rules.names.reserved_sdf_name import ReservedSdfName

    return (
        LinkJointSameName,
        InvalidNameCharacters,
        ReservedSdfName,
    )
