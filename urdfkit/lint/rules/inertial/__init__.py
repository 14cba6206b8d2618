"""Rules on masses and inertia tensors."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.inertial.inertia_not_positive_definite import InertiaNotPositiveDefinite
    from urdfkit.lint.rules.inertial.inertia_triangle_inequality import InertiaTriangleInequality

    return (
        InertiaNotPositiveDefinite,
        InertiaTriangleInequality,
    )
