"""Rules on joints, axes and limits."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.joints.axis_missing import AxisMissing
    from urdfkit.lint.rules.joints.axis_not_along_wheel import AxisNotAlongWheel
    from urdfkit.lint.rules.joints.axis_not_normalised import AxisNotNormalised
    from urdfkit.lint.rules.joints.axis_or_limit_on_fixed import AxisOrLimitOnFixed
    from urdfkit.lint.rules.joints.axis_zero import AxisZero
    from urdfkit.lint.rules.joints.continuous_with_position_limits import ContinuousWithPositionLimits
    from urdfkit.lint.rules.joints.dynamics_empty_or_negative import DynamicsEmptyOrNegative
    from urdfkit.lint.rules.joints.effort_or_velocity_zero import EffortOrVelocityZero
    from urdfkit.lint.rules.joints.joint_type_missing import JointTypeMissing
    from urdfkit.lint.rules.joints.joint_type_unknown import JointTypeUnknown
    from urdfkit.lint.rules.joints.limit_effort_or_velocity_missing import LimitEffortOrVelocityMissing
    from urdfkit.lint.rules.joints.limit_equal import LimitEqual
    from urdfkit.lint.rules.joints.limit_lower_above_upper import LimitLowerAboveUpper
    from urdfkit.lint.rules.joints.limit_missing import LimitMissing
    from urdfkit.lint.rules.joints.limits_in_degrees import LimitsInDegrees
    from urdfkit.lint.rules.joints.mimic_joint_undefined import MimicJointUndefined
    from urdfkit.lint.rules.joints.negative_effort_or_velocity import NegativeEffortOrVelocity
    from urdfkit.lint.rules.joints.safety_controller_inconsistent import SafetyControllerInconsistent

    return (
        JointTypeMissing,
        JointTypeUnknown,
        LimitMissing,
        LimitEffortOrVelocityMissing,
        LimitLowerAboveUpper,
        LimitEqual,
        LimitsInDegrees,
        EffortOrVelocityZero,
        NegativeEffortOrVelocity,
        AxisZero,
        AxisNotNormalised,
        AxisMissing,
        AxisNotAlongWheel,
        ContinuousWithPositionLimits,
        MimicJointUndefined,
        AxisOrLimitOnFixed,
        DynamicsEmptyOrNegative,
        SafetyControllerInconsistent,
    )
