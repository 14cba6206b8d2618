"""Rules on the tree of links and joints."""

from __future__ import annotations

TYPE_CHECKING = False
if TYPE_CHECKING:
    from urdfkit.lint.rule import RobotRule


def robot_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules on the expanded robot."""
    from urdfkit.lint.rules.tree.child_link_undefined import ChildLinkUndefined
    from urdfkit.lint.rules.tree.duplicate_joint import DuplicateJoint
    from urdfkit.lint.rules.tree.duplicate_link import DuplicateLink
    from urdfkit.lint.rules.tree.multiple_parents import MultipleParents
    from urdfkit.lint.rules.tree.multiple_roots import MultipleRoots
    from urdfkit.lint.rules.tree.no_root_or_cycle import NoRootOrCycle
    from urdfkit.lint.rules.tree.parent_link_undefined import ParentLinkUndefined

    return (
        ParentLinkUndefined,
        ChildLinkUndefined,
        MultipleRoots,
        NoRootOrCycle,
        MultipleParents,
        DuplicateLink,
        DuplicateJoint,
    )


def targeted_rules() -> tuple[type[RobotRule], ...]:
    """Return the rules that are asked for some targets only."""
    from urdfkit.lint.rules.tree.root_link_has_inertia import RootLinkHasInertia

    return (RootLinkHasInertia,)
