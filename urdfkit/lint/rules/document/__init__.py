"""Rules on the XML document and the values in it."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import FaultRule, RobotRule, Rule, SourceRule


def source_rules() -> tuple[type[SourceRule], ...]:
    """Return the rules on the text of each file."""
    from urdfkit.lint.rules.document.unbound_namespace_prefix import UnboundNamespacePrefix
    from urdfkit.lint.rules.document.wrong_xacro_namespace_uri import WrongXacroNamespaceUri

    return (
        UnboundNamespacePrefix,
        WrongXacroNamespaceUri,
    )


def fault_rules() -> tuple[type[FaultRule], ...]:
    """Return the rules on what xacro could not expand."""
    from urdfkit.lint.rules.document.xml_not_well_formed import XmlNotWellFormed

    return (XmlNotWellFormed,)


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.document.bad_number import BadNumber
    from urdfkit.lint.rules.document.duplicate_singleton_element import DuplicateSingletonElement
    from urdfkit.lint.rules.document.nan_or_inf import NanOrInf
    from urdfkit.lint.rules.document.plugin_outside_gazebo import PluginOutsideGazebo
    from urdfkit.lint.rules.document.required_missing import RequiredMissing
    from urdfkit.lint.rules.document.robot_name_missing import RobotNameMissing
    from urdfkit.lint.rules.document.rpy_in_degrees import RpyInDegrees
    from urdfkit.lint.rules.document.stray_quote import StrayQuote
    from urdfkit.lint.rules.document.unexpected_text import UnexpectedText
    from urdfkit.lint.rules.document.unknown_attribute import UnknownAttribute
    from urdfkit.lint.rules.document.unknown_element import UnknownElement
    from urdfkit.lint.rules.document.wrong_arity import WrongArity

    return (
        RobotNameMissing,
        UnexpectedText,
        UnknownElement,
        UnknownAttribute,
        BadNumber,
        WrongArity,
        NanOrInf,
        DuplicateSingletonElement,
        RequiredMissing,
        StrayQuote,
        RpyInDegrees,
        PluginOutsideGazebo,
    )


def suppression_rules() -> tuple[type[Rule], ...]:
    """Return the rules on the comments that suppress findings."""
    from urdfkit.lint.rules.document.unknown_suppression import UnknownSuppression

    return (UnknownSuppression,)
