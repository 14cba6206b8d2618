"""The rules, by layer. `RULES` is all of them in the order of their codes.

They are imported when they are asked for: a clean file needs neither the pages of the catalogue nor the fault rules.
"""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule

    RULES: tuple[type[Rule], ...]


def source_rules() -> tuple[type[SourceRule], ...]:
    """Return the rules on the text of each file."""
    from urdfkit.lint.rules.document.unbound_namespace_prefix import UnboundNamespacePrefix
    from urdfkit.lint.rules.xacro.unprefixed_directive import UnprefixedDirective
    from urdfkit.lint.rules.xacro.unprefixed_macro_call import UnprefixedMacroCall

    return (UnboundNamespacePrefix, UnprefixedDirective, UnprefixedMacroCall)


def fault_rules() -> tuple[type[FaultRule], ...]:
    """Return the rules on what xacro could not expand."""
    from urdfkit.lint.rules.document.xml_not_well_formed import XmlNotWellFormed
    from urdfkit.lint.rules.xacro.conditional_not_boolean import ConditionalNotBoolean
    from urdfkit.lint.rules.xacro.expansion_error import ExpansionError
    from urdfkit.lint.rules.xacro.expression_error import ExpressionError
    from urdfkit.lint.rules.xacro.include_cycle import IncludeCycle
    from urdfkit.lint.rules.xacro.include_not_found import IncludeNotFound
    from urdfkit.lint.rules.xacro.macro_args_mismatch import MacroArgsMismatch
    from urdfkit.lint.rules.xacro.property_used_before_definition import PropertyUsedBeforeDefinition
    from urdfkit.lint.rules.xacro.undefined_argument import UndefinedArgument
    from urdfkit.lint.rules.xacro.undefined_property import UndefinedProperty
    from urdfkit.lint.rules.xacro.unknown_macro import UnknownMacro

    return (
        XmlNotWellFormed,
        UnknownMacro,
        UndefinedProperty,
        PropertyUsedBeforeDefinition,
        UndefinedArgument,
        MacroArgsMismatch,
        IncludeNotFound,
        IncludeCycle,
        ConditionalNotBoolean,
        ExpressionError,
        ExpansionError,
    )


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.document.bad_number import BadNumber
    from urdfkit.lint.rules.document.unknown_element import UnknownElement
    from urdfkit.lint.rules.gazebo.plugin_joint_undefined import PluginJointUndefined
    from urdfkit.lint.rules.inertial.inertia_not_positive_definite import InertiaNotPositiveDefinite
    from urdfkit.lint.rules.inertial.inertia_triangle_inequality import InertiaTriangleInequality
    from urdfkit.lint.rules.joints.joint_type_missing import JointTypeMissing
    from urdfkit.lint.rules.joints.joint_type_unknown import JointTypeUnknown
    from urdfkit.lint.rules.joints.limit_lower_above_upper import LimitLowerAboveUpper
    from urdfkit.lint.rules.joints.limit_missing import LimitMissing
    from urdfkit.lint.rules.tree.child_link_undefined import ChildLinkUndefined
    from urdfkit.lint.rules.tree.duplicate_joint import DuplicateJoint
    from urdfkit.lint.rules.tree.duplicate_link import DuplicateLink
    from urdfkit.lint.rules.tree.multiple_parents import MultipleParents
    from urdfkit.lint.rules.tree.multiple_roots import MultipleRoots
    from urdfkit.lint.rules.tree.no_root_or_cycle import NoRootOrCycle
    from urdfkit.lint.rules.tree.parent_link_undefined import ParentLinkUndefined

    return (
        UnknownElement,
        BadNumber,
        ParentLinkUndefined,
        ChildLinkUndefined,
        MultipleRoots,
        NoRootOrCycle,
        MultipleParents,
        DuplicateLink,
        DuplicateJoint,
        JointTypeMissing,
        JointTypeUnknown,
        LimitMissing,
        LimitLowerAboveUpper,
        InertiaNotPositiveDefinite,
        InertiaTriangleInequality,
        PluginJointUndefined,
    )


def suppression_rules() -> tuple[type[Rule], ...]:
    """Return the rules on the comments that suppress findings."""
    from urdfkit.lint.rules.document.unknown_suppression import UnknownSuppression

    return (UnknownSuppression,)


def __getattr__(name: str) -> Any:
    if name != "RULES":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    every = (*source_rules(), *fault_rules(), *robot_rules(), *suppression_rules())
    return tuple(sorted(every, key=lambda rule: rule.code))
