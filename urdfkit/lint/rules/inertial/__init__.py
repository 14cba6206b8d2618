"""Rules on masses and inertia tensors."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.inertial.collision_without_inertial import CollisionWithoutInertial
    from urdfkit.lint.rules.inertial.com_outside_geometry import ComOutsideGeometry
    from urdfkit.lint.rules.inertial.inertia_copy_paste import InertiaCopyPaste
    from urdfkit.lint.rules.inertial.inertia_decimal_slip import InertiaDecimalSlip
    from urdfkit.lint.rules.inertial.inertia_identity import InertiaIdentity
    from urdfkit.lint.rules.inertial.inertia_not_positive_definite import InertiaNotPositiveDefinite
    from urdfkit.lint.rules.inertial.inertia_too_large import InertiaTooLarge
    from urdfkit.lint.rules.inertial.inertia_too_small import InertiaTooSmall
    from urdfkit.lint.rules.inertial.inertia_transposed import InertiaTransposed
    from urdfkit.lint.rules.inertial.inertia_triangle_inequality import InertiaTriangleInequality
    from urdfkit.lint.rules.inertial.inertia_zero import InertiaZero
    from urdfkit.lint.rules.inertial.mass_nonpositive import MassNonpositive
    from urdfkit.lint.rules.inertial.mass_vs_volume import MassVsVolume
    from urdfkit.lint.rules.inertial.moving_link_without_inertial import MovingLinkWithoutInertial

    return (
        MassNonpositive,
        InertiaNotPositiveDefinite,
        InertiaTriangleInequality,
        InertiaZero,
        InertiaTransposed,
        InertiaDecimalSlip,
        InertiaTooLarge,
        InertiaTooSmall,
        InertiaIdentity,
        InertiaCopyPaste,
        MovingLinkWithoutInertial,
        CollisionWithoutInertial,
        ComOutsideGeometry,
        MassVsVolume,
    )
