"""Rules on what xacro makes of the files."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import FaultRule, RobotRule, SourceRule


def source_rules() -> tuple[type[SourceRule], ...]:
    """Return the rules on the text of each file."""
    from urdfkit.lint.rules.xacro.deprecated_call import DeprecatedCall
    from urdfkit.lint.rules.xacro.include_with_parameters import IncludeWithParameters
    from urdfkit.lint.rules.xacro.inertia_arguments import InertiaArguments
    from urdfkit.lint.rules.xacro.inertia_formula import InertiaFormula
    from urdfkit.lint.rules.xacro.rounded_pi import RoundedPi
    from urdfkit.lint.rules.xacro.unprefixed_directive import UnprefixedDirective
    from urdfkit.lint.rules.xacro.unprefixed_macro_call import UnprefixedMacroCall
    from urdfkit.lint.rules.xacro.xacro_in_plain_urdf import XacroInPlainUrdf

    return (
        UnprefixedDirective,
        UnprefixedMacroCall,
        RoundedPi,
        DeprecatedCall,
        IncludeWithParameters,
        InertiaFormula,
        InertiaArguments,
        XacroInPlainUrdf,
    )


def fault_rules() -> tuple[type[FaultRule], ...]:
    """Return the rules on what xacro could not expand."""
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
    from urdfkit.lint.rules.xacro.unexpanded_expression import UnexpandedExpression

    return (UnexpandedExpression,)
